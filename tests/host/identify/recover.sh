#!/usr/bin/env bash
# recover.sh VERP ROBOT.SDF [SEED] [SECONDS]: a generic21 with other servos than its file's plays the motion in a
# stand. `verp identify` finds each number within a tenth. host/guide/real-servos.md quotes the output.
set -euo pipefail
verp=$1 robot=$2 seed=${3:-5} length_s=${4:-60}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
sed -E 's/type="xm430_w210"/type="other"/; s/backlash_rad="0.0044"/backlash_rad="0.006"/
  0,/<verp:bus /{/<verp:bus /i <verp:servo_type name="other" like="xm430_w210" stall_torque_n_m="3.5" no_load_rev_min="70" armature_kg_m2="0.0085" f_base_n_m="0.021" f_strib_n_m="0.0273" l_base="0.0062" l_strib="0.2838" goal_delay_us="5000" source="a test"/>
  }' \
  "$robot" >other.sdf
"$verp" identify --motion m.action --for "$length_s" >said
"$verp" action play m.action --robot other.sdf --held --gains 25 --seed "$seed" --record a.mcap >said 2>&1 || { cat said; exit 1; }
"$verp" identify a.mcap --robot "$robot" --json >found.json
/usr/bin/python3 - <<'END'
import json, sys
truth = {"stall_torque_n_m": 3.5, "no_load_rev_min": 70, "armature_kg_m2": 0.0085, "friction_n_m": 0.0483, "load_friction": 0.29,
         "backlash_rad": 0.006, "goal_delay_us": 5000}
found = json.load(open("found.json"))
rows = {row["number"]: row for row in found["numbers"]}
bad = 0
for name, true in truth.items():
    row = rows[name]
    off = abs(row["now"] / true - 1) if row["now"] is not None else 1
    bad += off > 0.1
    print(f"{name:18} truth {true:8g}  believed {row['was']:8.4g}  found {row['now'] or 0:8.4g}  off {100 * off:4.1f} %")
print("held out, degrees:", found["held_out"])
sys.exit(bad > 0 or found["held_out"]["after_deg"] > 0.5 * found["held_out"]["before_deg"])
END

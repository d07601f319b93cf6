function verp_controller(seconds)
%VERP_CONTROLLER(SECONDS) A user's controller. It runs the robot's own controller and adds a nod of
% the head.
  if nargin < 1, seconds = 20; end
  core = verp.Core();
  pitch = find(strcmp(core.joint_names, 'head_pitch'));
  zero = core.count(pitch - 1, 0);

  function outputs = nod(inputs, outputs)
    up_rad = 0.3 * sin(0.05 * inputs.tick);
    outputs.goal_count(pitch) = outputs.goal_count(pitch) + core.count(pitch - 1, up_rad) - zero;
  end

  session = verp.Session();
  session.add('walk_s', seconds);
  session.control(@nod, true);
  most_rad = 0;
  while session.tick()
    seen = session.seen();
    most_rad = max(most_rad, seen.joint_rad(pitch));
  end
  fprintf('nodded by %.2f rad, body at %.2f m\n', most_rad, seen.truth.body_m(1));
  session.close();
  core.close();
end

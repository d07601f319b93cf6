set_tests_properties(${hil_serial} PROPERTIES LABELS "hil;scenario" TIMEOUT 900)
set_tests_properties(${hil_sample} PROPERTIES LABELS "hil;unit" TIMEOUT 900)
set_tests_properties(${hil_documented_bytes} PROPERTIES LABELS "hil;unit" TIMEOUT 120)

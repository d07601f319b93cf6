set_tests_properties(${timely_tests} PROPERTIES LABELS "hil;in-time" TIMEOUT 600 PROCESSORS 2)

set_tests_properties(${timely_tests} PROPERTIES LABELS "hil;in-time" PROCESSORS 2)

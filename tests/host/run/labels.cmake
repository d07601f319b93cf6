set_tests_properties(${timely_tests} PROPERTIES LABELS "hil;in-time" PROCESSORS 2)
set_tests_properties(${latency_tests} PROPERTIES LABELS "scenario;in-time" RUN_SERIAL ON)

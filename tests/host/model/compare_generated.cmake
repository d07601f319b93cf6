# cmake -DGENERATOR=PROGRAM -DROBOT=FOLDER -P compare_generated.cmake: fails unless the generator makes
# FOLDER/robot.sdf from FOLDER/NAME.table.
cmake_path(GET ROBOT FILENAME name)
execute_process(COMMAND ${GENERATOR} ${ROBOT}/${name}.table OUTPUT_VARIABLE made RESULT_VARIABLE status)
file(READ ${ROBOT}/robot.sdf committed)
if(NOT status EQUAL 0 OR NOT made STREQUAL committed)
  message(FATAL_ERROR "${ROBOT}/robot.sdf is out of date: verp_generate_robot ${ROBOT}/${name}.table > ${ROBOT}/robot.sdf")
endif()

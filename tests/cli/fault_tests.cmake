# Signals at seeded moments: old files or new ones, never a mixture. docs/reliability.md has the command for a thousand.
add_test(NAME "cli: faults in the middle"
         COMMAND python3 ${CMAKE_CURRENT_LIST_DIR}/faults/faults.py $<TARGET_FILE:sslam> --faults 26)
set_tests_properties("cli: faults in the middle" PROPERTIES COST 40)
# What runs short or goes away: the disk, memory, permission, readers, the folder, the images.
add_test(NAME "cli: shortages" COMMAND python3 ${CMAKE_CURRENT_LIST_DIR}/faults/shortage.py $<TARGET_FILE:sslam>)
set_tests_properties("cli: shortages" PROPERTIES COST 40)

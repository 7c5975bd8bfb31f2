# Real recordings, where they are at hand: the accuracy that the project promises for each, with one set of defaults. Errors
# are bounded by twice what was measured.
function(sslam_sequence_test recording normals share ate)
  set(name "sequence: ${recording} with normals ${normals}")
  add_test(NAME "${name}"
           COMMAND ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/check_sequence.py $<TARGET_FILE:sslam> ${recording} ${normals}
                   ${share} ${ate})
  set_tests_properties("${name}" PROPERTIES SKIP_RETURN_CODE 77)
endfunction()

sslam_sequence_test(tum_fr3_structure_notexture_far depth 0.9 0.04)
sslam_sequence_test(tum_fr3_structure_notexture_far none 0.9 0.04)
sslam_sequence_test(icl_nuim_of_kt0 depth 0.9 0.0016)
sslam_sequence_test(icl_nuim_of_kt0 none 0.9 0.0016)
sslam_sequence_test(office_kt2 none 0.95 0.004)

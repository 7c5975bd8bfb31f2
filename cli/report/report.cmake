# The report's page, assembled at build time. three.js comes from npm at configure time; where that does not work, the
# page draws its top view in two dimensions and says so.
set(report_source "${CMAKE_CURRENT_LIST_DIR}")
set(report_build "${CMAKE_CURRENT_BINARY_DIR}/report")
set(three "")
set(three_licence "")
find_program(SSLAM_NPM npm DOC "Fetches three.js for the 3D view of sslam's reports")
find_program(SSLAM_NODE node nodejs)
if(SSLAM_NPM AND SSLAM_NODE)
  file(COPY "${report_source}/package.json" "${report_source}/package-lock.json" DESTINATION "${report_build}")
  file(SHA256 "${report_source}/package-lock.json" wanted)
  set(installed "")
  if(EXISTS "${report_build}/installed")
    file(READ "${report_build}/installed" installed)
  endif()
  if(NOT installed STREQUAL wanted)
    message(STATUS "Fetching three.js for the report's 3D view")
    execute_process(COMMAND "${SSLAM_NPM}" ci --ignore-scripts --no-audit --no-fund
                            --fetch-retries=1 --fetch-retry-mintimeout=2000
                    WORKING_DIRECTORY "${report_build}"
                    TIMEOUT 120 RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
    if(NOT failed)
      file(WRITE "${report_build}/installed" "${wanted}")
      set(installed "${wanted}")
    endif()
  endif()
  if(installed STREQUAL wanted)
    set(three "${report_build}/three.js")
    set(three_licence "${report_build}/node_modules/three/LICENSE")
    add_custom_command(
      OUTPUT "${three}"
      COMMAND ${CMAKE_COMMAND} -E copy "${report_source}/three_parts.js" "${report_build}"
      COMMAND "${report_build}/node_modules/.bin/esbuild" three_parts.js --bundle --minify --format=iife
              --global-name=THREE --legal-comments=none --log-level=warning --outfile=three.js
      WORKING_DIRECTORY "${report_build}"
      DEPENDS "${report_source}/three_parts.js" "${report_source}/package-lock.json"
      COMMENT "Bundling three.js")
  endif()
endif()
if(NOT three)
  message(STATUS "No three.js (npm or the network is missing): reports show the map in two dimensions")
endif()

# sslam_page(NAME HTML bundle of three.js or empty, script...): NAME.inc, the page as bytes.
function(sslam_page name html bundle)
  list(TRANSFORM ARGN PREPEND "${report_source}/" OUTPUT_VARIABLE files)
  add_custom_command(
    OUTPUT "${report_build}/${name}.inc"
    COMMAND ${CMAKE_COMMAND} "-DSOURCE=${report_source}" "-DHTML=${html}" "-DSCRIPTS=${ARGN}" "-DTHREE=${bundle}"
            "-DTHREE_LICENCE=${three_licence}" "-DPAGE=${report_build}/${name}.html"
            "-DBYTES=${report_build}/${name}.inc" -P "${report_source}/assemble.cmake"
    DEPENDS "${report_source}/assemble.cmake" "${report_source}/${html}" "${report_source}/style.css" ${files} ${bundle}
    COMMENT "Assembling ${html}"
    VERBATIM)
endfunction()

set(report_tools format.js controls.js data.js plot.js save.js)
sslam_page(report_page page.html "${three}" ${report_tools} surfaces.js story.js top_view.js viewpoint.js scene_parts.js legend.js scene.js
           charts.js views.js sphere.js tables.js pick.js live.js main.js)
sslam_page(compare_page compare.html "" ${report_tools} compare_paths.js compare.js)

# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
#
# Files that the program holds, embedded as raw string literals ("embedded/report.css.inc" and so on): report/page/*,
# of which report.html is made, in edgecase_report; which case catches which fault in edgecase_rasterizers; the C
# program of a reproducer, cli/reproducer/program/*, in edgecase_cli.
set(EDGECASE_EMBED_DIR ${CMAKE_BINARY_DIR}/embedded)
file(GLOB parts CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/report/page/*.html ${CMAKE_SOURCE_DIR}/report/page/*.css
     ${CMAKE_SOURCE_DIR}/report/page/*.js ${CMAKE_SOURCE_DIR}/cli/reproducer/program/*.c)
foreach(source ${parts} ${CMAKE_SOURCE_DIR}/rasterizers/strength/matrix.tsv)
    get_filename_component(part ${source} NAME)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
    file(READ ${source} text)
    file(WRITE ${EDGECASE_EMBED_DIR}/${part}.tmp "R\"EDGECASE(${text})EDGECASE\"\n")
    configure_file(${EDGECASE_EMBED_DIR}/${part}.tmp ${EDGECASE_EMBED_DIR}/embedded/${part}.inc COPYONLY)
endforeach()
target_include_directories(edgecase_report PRIVATE ${EDGECASE_EMBED_DIR})
target_include_directories(edgecase_rasterizers PRIVATE ${EDGECASE_EMBED_DIR})

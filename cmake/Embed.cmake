# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
#
# report/page/*: the page that report.html is made from, kept as real files and embedded in
# edgecase_report as raw string literals ("embedded/report.css.inc" and so on).
set(EDGECASE_EMBED_DIR ${CMAKE_BINARY_DIR}/embedded)
foreach(part report.html report.css dom.js exact.js geometry.js pictures.js canvas.js viewer.js inspector.js
        case.js overview.js main.js compare.html compare.js)
    set(source ${CMAKE_SOURCE_DIR}/report/page/${part})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
    file(READ ${source} text)
    file(WRITE ${EDGECASE_EMBED_DIR}/${part}.tmp "R\"EDGECASE(${text})EDGECASE\"\n")
    configure_file(${EDGECASE_EMBED_DIR}/${part}.tmp ${EDGECASE_EMBED_DIR}/embedded/${part}.inc COPYONLY)
endforeach()
target_include_directories(edgecase_report PRIVATE ${EDGECASE_EMBED_DIR})

# Writes the guide as HTML pages that any browser reads:
#   cmake -DPAGES=DIR -DREFERENCE=FILE.md -DOUT=DIR -DCMARK=PROGRAM -P book.cmake
# PAGES has the Markdown pages and, beside it, their pictures; REFERENCE is what `protocols --reference` prints.
set(contents "<a href=\"index.html\">The guide</a>\n")
file(READ ${PAGES}/index.md index)
string(REGEX MATCHALL "\\[[^]]*\\]\\([a-z-]+\\.md\\)" links "${index}")
foreach(link ${links})
    string(REGEX REPLACE "\\[(.*)\\]\\((.*)\\.md\\)" "<a href=\"\\2.html\">\\1</a>" entry "${link}")
    string(APPEND contents "${entry}\n")
endforeach()

file(MAKE_DIRECTORY ${OUT})
file(GLOB pictures ${PAGES}/../*.png)
file(COPY ${pictures} ${CMAKE_CURRENT_LIST_DIR}/book.css DESTINATION ${OUT})
file(GLOB pages ${PAGES}/*.md)
foreach(page ${pages} ${REFERENCE})
    execute_process(COMMAND ${CMARK} --extension table --unsafe ${page} OUTPUT_VARIABLE body RESULT_VARIABLE failed)
    if(failed)
        message(FATAL_ERROR "${CMARK} cannot read ${page}")
    endif()
    string(REGEX REPLACE "href=\"([a-z-]+)\\.md" "href=\"\\1.html" body "${body}")
    string(REPLACE "src=\"../" "src=\"" body "${body}")
    string(REGEX MATCH "<h1>([^\n]*)</h1>" heading "${body}")
    set(title "${CMAKE_MATCH_1}")
    get_filename_component(name ${page} NAME_WE)
    string(REPLACE "href=\"${name}.html\"" "href=\"${name}.html\" aria-current=\"page\"" nav "${contents}")
    file(CONFIGURE OUTPUT ${OUT}/${name}.html CONTENT [[<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>@title@ – Tactoscope</title>
<link rel="stylesheet" href="book.css">
</head>
<body>
<nav>@nav@</nav>
<main>
@body@</main>
</body>
</html>
]] @ONLY)
endforeach()

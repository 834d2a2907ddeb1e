# tools/citations.awk - compares citations with the bibliography, for check_citations. The first
# file is the bibliography, the second the errata; all but the first cite.

# An entry begins "- **Key**", and may have another one: "also **Key**".
FILENAME == ARGV[1] {
    if ($0 !~ /^- \*\*/) next
    line = $0
    while (match(line, /\*\*[^*]+\*\*/)) {
        entry[substr(line, RSTART + 2, RLENGTH - 4)] = FNR
        line = substr(line, RSTART + RLENGTH)
    }
    next
}

# The errata: a row of the table for each slip.
FILENAME == ARGV[2] && /^[|] [0-9]+ [|]/ { slip[$2] = 1 }

# A citation ends in the line where it begins, or in the next one.
{
    text = $0
    sub(/^[ \t]*(\*|\/\*|\/\/|#)?[ \t]*/, "", text)
    where = FILENAME ":" FNR
    body = (FNR == 1 ? "" : body " ") text
    if (FILENAME != ARGV[2] && match(text, /[Ss]lip [0-9]+/) &&
        !(substr(text, RSTART + 5, RLENGTH - 5) in slip)) {
        print where ": docs/errata.md has no " substr(text, RSTART, RLENGTH)
        wrong = 1
    }
    take()
    if (FILENAME ~ /\.def$/) bare("\"", $0)
    if (FILENAME == "docs/glossary.md") bare("|", $0)
}
END {
    for (key in entry)
        if (!(key in cited) && key !~ /^thesis/) {
            print "docs/bibliography.md:" entry[key] ": nothing cites " key
            wrong = 1
        }
    exit wrong
}

# The citations in brackets; keeps what an open bracket begins.
function take(    inside)
{
    while (match(body, /\[[^][]*[a-z.,)] (19|20)[0-9][0-9][^][]*\]/)) {
        inside = substr(body, RSTART + 1, RLENGTH - 2)
        body = substr(body, RSTART + RLENGTH)
        if (body !~ /^\(/) each(inside) # a link of Markdown goes on with (
    }
    sub(/^.*\]/, "", body)
    body = match(body, /\[[^][]*$/) && RLENGTH < 300 ? substr(body, RSTART) : ""
}

# Cells of a table, or strings, that end in a year, or have one before a semicolon.
function bare(mark, line,    cell, n, i)
{
    n = split(line, cell, mark == "|" ? "[|]" : mark)
    for (i = 2; i <= n; i++)
        if (cell[i] ~ /[a-z.,)] (19|20)[0-9][0-9][ ]*($|;)/) each(cell[i])
}

function each(list,    part, n, i, key)
{
    n = split(list, part, ";")
    for (i = 1; i <= n; i++) {
        if (!match(part[i], /[A-Z][^0-9"]* (19|20)[0-9][0-9]/)) continue
        key = substr(part[i], RSTART, RLENGTH)
        cited[key] = 1
        if (!(key in entry)) {
            print where ": no entry for " key
            wrong = 1
        }
    }
}

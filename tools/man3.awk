# tools/man3.awk - a manual page of section 3 from a public header, for make_man3.
#
# A comment /** ... */ belongs to the declaration that follows it; the one with @file is the page's
# own. What a comment says goes into the page as it is: paragraphs, lists of lines that begin with
# "- ", @param and @return. -v page: its name; -v header: as programs include it; -v package: its
# name for pkg-config; -v date; -v names: a file that receives the functions, a line each.

function escape(text)
{
    gsub(/\\/, "\\e", text)
    sub(/^[.']/, "\\\\\\&&", text)
    return text
}

# A line of text: mdoc wants each sentence to begin a line.
function out(text,    sentence, n, i)
{
    text = escape(text)
    gsub(/App\. /, "App.\\~", text)
    n = split(text, sentence, /[.] +/)
    for (i = 1; i < n; i++) print sentence[i] "."
    print sentence[n]
}

# Ends a list of parameters or of points.
function end_list()
{
    if (list) print ".El"
    list = ""
}

function begin_list(kind)
{
    if (list == kind) return
    end_list()
    print kind == "points" ? ".Bl -bullet -compact" : ".Bl -tag -width Ds -compact"
    list = kind
}

# The lines of a comment, doc[1] to doc[docs].
function print_comment(    i, line, fresh)
{
    list = ""
    fresh = 0
    for (i = 1; i <= docs; i++) {
        line = doc[i]
        if (line ~ /^@file/) continue
        if (line == "") {
            fresh = 1
            continue
        }
        if (line ~ /^@param /) {
            if (list != "params") {
                end_list()
                print ".Pp"
                begin_list("params")
            }
            sub(/^@param +/, "", line)
            match(line, /^[A-Za-z_0-9]+(, [A-Za-z_0-9]+)*/)
            print ".It " substr(line, 1, RLENGTH)
            line = substr(line, RLENGTH + 1)
            sub(/^ +/, "", line)
        } else if (line ~ /^@return /) {
            end_list()
            print ".Pp"
            sub(/^@return +/, "Returns ", line)
        } else if (line ~ /^- /) {
            if (list != "points") begin_list("points")
            print ".It"
            sub(/^- /, "", line)
        } else if (fresh && list) {
            end_list()
            print ".Pp"
        } else if (fresh) {
            print ".Pp"
        }
        fresh = 0
        if (line ~ /^    [^ ]/ && !list) { # an example
            sub(/^ +/, "", line)
            print ".Dl " escape(line)
            continue
        }
        sub(/^ +/, "", line)
        if (line != "") out(line)
    }
    end_list()
}

# The name of a declaration: of a function the word before "(", else the last word.
function name_of(text,    word, n)
{
    if (text ~ /^#define/) {
        split(text, word, /[ (]/)
        return word[2]
    }
    if (text ~ /^typedef (struct|enum|union) [a-z_0-9]+/) {
        split(text, word, /[ ;]/)
        return word[3]
    }
    if (match(text, /[a-z_0-9]+ *\(/)) {
        text = substr(text, RSTART, RLENGTH - 1)
        sub(/ +$/, "", text)
        return text
    }
    sub(/;.*/, "", text)
    n = split(text, word, /[ *]+/)
    return word[n]
}

function print_item(    title, is_function, i)
{
    title = name_of(declaration[1] " " declaration[2])
    print ".Ss " title
    print ".Bd -literal -compact"
    is_function = declaration[1] ~ /^MW_API/
    sub(/^MW_API /, "", declaration[1])
    for (i = 1; i <= declarations; i++) {
        if (is_function && i > 1) sub(/^       /, "", declaration[i])
        gsub(/\/\*\*</, "/*", declaration[i])
        sub(/\/\*\* /, "/* ", declaration[i])
        print escape(declaration[i])
    }
    print ".Ed"
    print ".Pp"
    print_comment()
    if (is_function) print title >names
}

function begin_page(    i, brief)
{
    for (i = 1; i <= docs && brief == ""; i++)
        if (doc[i] !~ /^@file/) brief = doc[i]
    sub(/\.( .*)?$/, "", brief)
    print ".Dd " date
    print ".Dt " toupper(page) " 3"
    print ".Os meshwalk"
    print ".Sh NAME"
    print ".Nm " page
    print ".Nd " tolower(substr(brief, 1, 1)) substr(brief, 2)
    print ".Sh SYNOPSIS"
    print ".In " header
    print ".Pp"
    print (package ~ /-mpi$/ ? "mpicc" : "cc") " ... $(pkg-config --cflags --libs " package ")"
    print ".Sh DESCRIPTION"
    print_comment()
    print ".Sh INTERFACE"
}

function open_braces(text,    opened, closed)
{
    opened = gsub(/\{/, "", text)
    closed = gsub(/\}/, "", text)
    return opened - closed
}

# --- lines of the header

in_comment {
    line = $0
    closes = sub(/ *\*\/ *$/, "", line)
    sub(/^ *\* ?/, "", line)
    if (!(closes && line == "")) doc[++docs] = line
    if (closes) {
        in_comment = 0
        after_comment = 1
        if (doc[1] ~ /^@file/) {
            begin_page()
            after_comment = 0
        }
    }
    next
}
!in_item && /^\/\*\*/ {
    docs = 0
    line = $0
    sub(/^\/\*\* ?/, "", line)
    if (sub(/ *\*\/ *$/, "", line)) {
        doc[++docs] = line
        after_comment = 1
    } else {
        if (line != "") doc[++docs] = line
        in_comment = 1
    }
    next
}
after_comment {
    after_comment = 0
    in_item = 1
    declarations = 0
    braces = 0
}
in_item {
    declaration[++declarations] = $0
    braces += open_braces($0)
    if (braces == 0 && ($0 ~ /;[^;]*$/ && $0 !~ /^ +\*/ ||
                        declaration[1] ~ /^#define/ && $0 !~ /\\$/)) {
        in_item = 0
        print_item()
    }
}

END {
    print ".Sh SEE ALSO"
    print ".Xr meshwalk 1"
}

#!/usr/bin/env bash
# Options: help, mistakes and their hints, strict numbers; help, manual pages and completion name
# the same options.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
# As in cli_vectors.sh: the leak checker may crash over the threads of GDAL.
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"

# All that the program lists: a new one is asked for its page and its completion, too.
mapfile -t commands < <("$meshwalk" --help | sed -n 's/^  \([a-z][a-z]*\) .*/\1/p')

help_options() { sed -nE '/^  (-[a-z],|   ) --[a-z]/p' "$logs/out" |
    grep -oE -- '^ +(-[a-z], )?--[a-z-]+' | tr -s ', ' '\n' | grep . | sort; }

run; refused 2 "which command\?.*--help"
run --version; exits 0; prints_line '^meshwalk [0-9]+\.[0-9]+\.[0-9]+$'; says_nothing
prints_line '^  netCDF   ([0-9]+\.[0-9]+.*found|libnetcdf is not found)'
prints_line '^  view     (built in|not built in): '
for library in zlib Jansson Cairo GDAL LAZ; do
    prints_line "^  $library +([0-9.]+,? (built in|found)|built in, but |not built in): ?"
done
run help; exits 0; prints_line '^usage: meshwalk COMMAND'
run help raster; exits 0; cp "$logs/out" "$logs/first"
run raster --help; exits 0; holds "help raster is raster --help" cmp -s "$logs/out" "$logs/first"
run help raster all; exits 0; cp "$logs/out" "$logs/first"
run raster --help all; holds "help raster all is that with all" cmp -s "$logs/out" "$logs/first"
run help rastre; refused 2 "unknown command 'rastre'; did you mean 'raster'"
run --help; exits 0; says_nothing
all_commands=$(<"$logs/out")
run -h; exits 0; says_nothing; prints "$all_commands"
for c in "${commands[@]}"; do prints_line "^  $c "; done
for c in "${commands[@]}"; do
    for option in --help -h '--help all' '-h all' --help=all; do
        # shellcheck disable=SC2086 # words
        run "$c" $option; exits 0; says_nothing
        prints_line "^usage: meshwalk $c "
        holds "no line of the help is longer than 80 characters" test -z \
            "$(grep -E '.{81}' "$logs/out")"
    done
done

# --help shows five options, and names the others; --help all shows all of them.
for c in "${commands[@]}"; do
    run "$c" --help all; help_options >"$logs/all"
    for form in '-h all' --help=all; do
        cp "$logs/out" "$logs/first"
        # shellcheck disable=SC2086 # words
        run "$c" $form; holds "$form is --help all" cmp -s "$logs/out" "$logs/first"
    done
    run "$c" --help
    holds "--help of $c shows five options" test "$(help_options | grep -c -- '^--')" == 5
    prints_line "^'meshwalk $c --help all' describes the other options:"
    { help_options; sed -n "/--help all' describes/,/^\$/p" "$logs/out" |
        grep -oE -- '(^| )--[a-z-]+' | tr -d ' '; } |
        grep -- '^--' | grep -vx -- '--help' | sort >"$logs/named"
    grep -- '^--' "$logs/all" | grep -vx -- '--help' >"$logs/expected"
    holds "--help of $c names every option: $(diff "$logs/named" "$logs/expected")" same_text \
        "$logs/named" "$logs/expected"
done
run sample --help=some; refused 2 "'--help' takes no argument"

# Mistakes.
run locat a b; refused 2 "unknown command 'locat'; did you mean 'locate'\?"
run --versoin; refused 2 "did you mean '--version'\?"
run zzzzzz; refused 2 "unknown command 'zzzzzz'$"
run locate --tolerence 1 a b; refused 2 "unknown option '--tolerence'; did you mean '--tolerance'\?"
run locate --arith double a b; refused 2 "did you mean '--arithmetic'\?"
run locate --xyzzy a b; refused 2 "unknown option '--xyzzy'$"
run locate -Z a b; refused 2 "unknown option '-Z'"
run locate --walk lawsn a b; refused 2 "unknown walk 'lawsn'; did you mean 'lawson'\?"
run locate --start centr a b; refused 2 "unknown start 'centr'; did you mean 'centre'\?"
run locate --finish lawson a b; refused 2 "unknown way to finish 'lawson'"
run locate --arithmetic fuzzy a b; refused 2 "unknown arithmetic 'fuzzy'"
run locate --walk; refused 2 "'--walk' needs an argument: NAME"
run locate --any=yes a b; refused 2 "'--any' takes no argument"
run locate a; refused 2 "expected MESH POINTS, found 1 argument;"
run locate a b c; refused 2 "expected MESH POINTS, found 3 arguments"
run locate '' b; refused 2 "the name of a file is empty"
run edit a b; refused 2 "edit: -o MESH is missing"
run edit a -o b.off; refused 2 "expected MESH EDITS -o OUT, found 1 argument"
run edit a b -o -; refused 2 "edit: a mesh on standard output needs --format"
run edit a b -o c; refused 2 "c: no mesh format has this ending"
run edit - - -o c.off; refused 2 "can be read only once"
run edit a b -o c.off --delaunay mak
refused 2 "unknown way of --delaunay 'mak'; did you mean 'make'\?"
run edit a b -o c.off --cells 1073741825; refused 2 "'--cells' must be at most 2\^30"
run edit a b -o c.off --undo -1; refused 2 "'--undo' must be a whole number"
run info a b; refused 2 "expected MESH, found 2 arguments"
run locate - -; refused 2 "can be read only once"
run triangulate a; refused 2 "-o MESH is missing"
run triangulate a -o -; refused 2 "needs --format"
run triangulate a -o b.ply --limit x; refused 2 "whole number"
run triangulate a -o b.ply --kind gredy; refused 2 "did you mean 'greedy'\?"
run triangulate a -o b.ply --class swamp; refused 2 "unknown class 'swamp'"
run triangulate a -o b.ply --class 2,256; refused 2 "unknown class '256'"
run triangulate a -o b.ply --class grond; refused 2 "did you mean 'ground'\?"
run triangulate a -o b.ply --class 2,; refused 2 "unknown class ''"
run triangulate a -o b.ply --format pyl; refused 2 "unknown format 'pyl'; did you mean 'ply'\?"
run star --walk orthogonl a b; refused 2 "unknown walk 'orthogonl'; did you mean 'orthogonal'\?"
run star --walk lawson a b; refused 2 "unknown walk 'lawson'"
run star --start octaedron a b; refused 2 "unknown start 'octaedron'; did you mean 'octahedron'\?"
run star --finish straight a b; refused 2 "unknown way to finish 'straight'$"
run star --finish forgetfull a b
refused 2 "unknown way to finish 'forgetfull'; did you mean 'forgetful'\?"
run star --center 1,2,3 a b; refused 2 "unknown option '--center'; did you mean '--centre'\?"
run star --cells 1073741825 a b; refused 2 "'--cells' must be at most 2\^30, not '1073741825'"
run star --levels 14 a b; refused 2 "'--levels' must be at most 13, not '14'"
run probe --start lst a b; refused 2 "unknown start 'lst'; did you mean 'last'\?"
run probe --race 257 a b; refused 2 "'--race' must be at most 256, not '257'"
run probe a; refused 2 "expected SURFACE QUERIES, found 1 argument;"
for c in info check; do
    run $c --as sphere a; refused 2 "unknown way to take a mesh 'sphere'"
    run $c --as str a; refused 2 "did you mean 'star'\?"
    for centre in 1,0,0 0,0,0; do
        run $c --centre $centre a; refused 2 "'--centre' needs --as star"
        run $c --as surface --centre=$centre a; refused 2 "'--centre' needs --as star"
    done
    run $c --as surface --lonlat a; refused 2 "'--lonlat' needs --as star"
    run $c --weld a; refused 2 "'--weld' needs --as surface"
done
run check --fix weld a; refused 2 "check: -o MESH is missing"
run check --fix wled a -o b.off; refused 2 "unknown repair 'wled'; did you mean 'weld'\?"
run check --fix weld, a -o b.off; refused 2 "unknown repair ''"
run check --fix weld a -o b; refused 2 "b: no mesh format has this ending"
run check --fix weld --numbers b.off a -o b.off
refused 2 "--output and --numbers cannot both go to b.off"
run check --fix all --as star --lonlat a -o b.off
refused 2 "--fix cannot mend a mesh with --lonlat"
for words in '--numbers n.csv' '--tolerance 1' '--format ply'; do
    # shellcheck disable=SC2086 # words
    run check $words a; refused 2 "need --fix"
done

# Numbers are taken as a whole or not at all.
for value in '' x 1x ' 1' '1,' '1,5' 0x1p3 nan inf 1e999 -1 -0.5 1e-400 0.1E-400 2e-324 \
    ".$(printf '%0400d' 1)"; do
    run locate --tolerance "$value" a b; refused 2 "'--tolerance' must be a length"
    run probe --max-distance "$value" a b; refused 2 "'--max-distance' must be a length"
done
for value in 0 0.000 0e9 .0E-400 -0 4e-324 1e-320 5e-324 1.5 007; do
    run locate --tolerance "$value" a b; refused 3 "a: No such file"
    run probe --max-distance "$value" a b; refused 3 "a: No such file"
done
for value in '' x 1 1,2 1,2, 1,2,3,4 1,2,x ' 1,2,3' '1, 2,3' '1;2;3' 1,2,inf nan,0,0 1,2,1e999 \
    0x1,2,3 ,,; do
    run star --centre "$value" a b; refused 2 "'--centre' must be a point X,Y,Z, not"
done
for value in '' x 1.5 -1 +1 ' 1' 1e3 0x10 4294967296 99999999999999999999; do
    run locate --threads "$value" a b; refused 2 "'--threads' must be"
done
run locate --threads 257 a b; refused 2 "at most 256"
for option in steps cells layers; do
    run locate --$option -1 a b; refused 2 "'--$option' must be a whole number"
done
for value in '' x 0 -1 1.5 4294967295 cube cuberoot; do
    run locate --sample "$value" a b; refused 2 "'--sample' must be .*, cube-root or fourth-root"
done
for value in '' x -1 1.0 18446744073709551616; do
    run locate --seed "$value" a b; refused 2 "'--seed' must be"
done
# The greatest and the least that each takes.
for words in '--threads 256' '--steps 4294967295' '--layers 8' '--sample 1' '--sample 4294967294' \
    '--seed 0' '--seed 18446744073709551615' '--cells 1073741824'; do
    # shellcheck disable=SC2086 # words
    run locate $words a b; refused 3 'a: No such file'
done
run probe --race 256 a b; refused 3 'a: No such file'
run star --levels 13 a b; refused 3 'a: No such file'
# A long name is told up to its 63rd letter.
for length in 62 63 64 65 300; do
    name=$(printf "%0${length}d" 0)
    run locate "--$name" a b; refused 2 "unknown option '--${name:0:63}'$"
done
# Options of points in the plane, where points are on a globe or a star.
for words in '--crs EPSG:1' '--tolerance 1' '--sample 3' '--steps 3' '--cells 3' '--layers 3' \
    '--walk lawson' '--start random' '--arithmetic double' '--finish stochastic' '--fill yes' \
    '--descent nearest' --areas --any --trust; do
    # shellcheck disable=SC2086 # words
    run sample a b --as star --field f $words; refused 2 "option '${words%% *}' cannot be used with --as star"
    # shellcheck disable=SC2086
    run weights a b --lonlat $words -o c.npz
    refused 2 "option '${words%% *}' is for points in the plane, not for --lonlat"
done
for walk in lawson remembering stochastic straight celestial; do
    run locate a b --fill no --walk $walk; refused 2 "--fill no needs --walk border, not $walk"
    run locate a b --fill auto --walk $walk; refused 3 'a: No such file'
done
run locate a b --fill no --walk border; refused 3 'a: No such file'
run locate a b --fill no; refused 3 'a: No such file'
only_files # none

# Forms of one option; the last one counts; -- ends them.
printf '%s\n' "$square" >m.off
printf '0.5 0.25\n' >p.xyz
run locate m.off p.xyz
answer=$(<"$logs/out")
for form in '--walk lawson' '--walk=lawson' '--walk straight --walk=lawson' \
    '--seed 18446744073709551615' '-q' \
    '--threads=2 -q' '--finish remembering' '--steps 5' '--areas --sample fourth-root' \
    '--tolerance 0' \
    '--tolerance=1e-3'; do
    # shellcheck disable=SC2086 # words
    run locate $form m.off p.xyz; exits 0; prints "$answer"; says_nothing
    # shellcheck disable=SC2086
    run locate m.off p.xyz $form; exits 0; prints "$answer"
done
run locate -qo a.csv m.off p.xyz; exits 0; prints ''
run locate -ob.csv m.off p.xyz; exits 0; prints ''
run locate m.off --output=c.csv -- p.xyz; exits 0; prints ''
for f in a b c; do holds "$f.csv holds the answer" test "$(<$f.csv)" == "$answer"; done
cp p.xyz ./--walk
run locate m.off -- --walk; exits 0; prints "$answer"

# The help, the manual page and the completion of a command name the same options and the same
# names.
manual_options() {
    sed -nE '/^\.It Fl/ { s/^\.It //; s/Fl Fl ([a-z-]+)/--\1/g; s/Fl ([a-z])/-\1/g; p }' "$1" |
        grep -oE -- '(^|[ ,])--?[a-z-]+' | tr -d ' ,' | sort
}
# shellcheck disable=SC1091
. "$source_tree/cli/meshwalk.bash"
complete_words() { # complete_words WORDS...: what the completion offers for the last word
    COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
    _meshwalk
    printf '%s\n' "${COMPREPLY[@]}" | sort
}
for c in "${commands[@]}"; do
    run "$c" --help all
    help_options >"$logs/help"
    holds "the help of $c names options" grep -qx -- --quiet "$logs/help"
    manual_options "$source_tree/docs/man/meshwalk-$c.1" >"$logs/manual"
    holds "help and manual page of $c differ: $(diff "$logs/help" "$logs/manual")" same_text \
        "$logs/help" "$logs/manual"
    complete_words meshwalk "$c" - >"$logs/completion"
    holds "help and completion of $c differ: $(diff "$logs/help" "$logs/completion")" \
        same_text "$logs/help" "$logs/completion"
done
# Names in files: of fields, of layers.
printf '%s\n' x,y,z,salt,temp 0,0,1,2,3 1,0,1,2,3 0,1,1,2,3 >fields.csv
run triangulate -q fields.csv -o fields.ply; exits 0
holds "the completion knows fields" \
    test "$(complete_words "$meshwalk" sample fields.ply fields.csv --field '' | xargs)" == \
    'salt temp z'
holds "and those that begin so" test \
    "$(complete_words "$meshwalk" sample fields.ply --field sa | xargs)" == salt
echo '{"type":"Feature","properties":{"id":1,"use":"a"},"geometry":{"type":"Point","coordinates":[0,0]}}' >wells.geojson
run info wells.geojson
if grep -Eq 'built with GDAL|cannot be loaded' "$logs/err"; then
    refused 3 'wells\.geojson: '
else
    exits 0; prints_line '^layers +wells$'; prints_line '^geometry +Point$'
    prints_line '^features +1$'
    prints_line '^fields +id, use$'; prints_line '^crs +GEOGCS'
    run info --layer none wells.geojson; refused 3 "has no layer 'none'"
    holds "the completion knows layers" \
        test "$(complete_words "$meshwalk" sample fields.ply wells.geojson --layer '' | xargs)" == \
        wells
    holds "and attributes" \
        test "$(complete_words "$meshwalk" locate --polygons wells.geojson --attribute u | xargs)" \
        == use
fi
run info --layer a fields.ply; refused 2 "'--layer' is for vector files"
row() { # row OPTION: the names that the help lists below an option in a row
    sed -nE "/ --$1 NAME/,/^ {0,6}--/p" "$logs/out" | sed -n '/:$/,$p' | grep -E '^ {26}[^ ]' |
        tr -s "', " '\n' | grep . | sort
}
listed() { # listed OPTION: the names that the help lists below an option
    sed -nE "/ --$1 NAME/,/^ {0,6}-/p" "$logs/out" | sed -nE 's/^ {26}.([a-z-]+). .*/\1/p' | sort
}
run locate --help all
for option in walk start descent; do
    holds "help and completion of --$option differ" \
        test "$(complete_words meshwalk locate --$option '')" == "$(listed $option)"
    holds "the help lists names of --$option" test -n "$(listed $option)"
done
for option in arithmetic finish; do
    holds "help and completion of --$option differ" \
        test "$(complete_words meshwalk locate --$option '')" == "$(row $option)"
done
run triangulate --help all
holds "help and completion of --format differ" \
    test "$(complete_words meshwalk triangulate --format '')" == "$(row format)"
for option in kind keep; do
    holds "help and completion of --$option differ" \
        test "$(complete_words meshwalk triangulate --$option '')" == "$(listed $option)"
    holds "the help lists names of --$option" test -n "$(listed $option)"
done
run edit --help all
holds "help and completion of edit --format differ" \
    test "$(complete_words meshwalk edit --format '')" == "$(row format)"
for option in delaunay walk start descent; do
    holds "help and completion of edit --$option differ" \
        test "$(complete_words meshwalk edit --$option '')" == "$(listed $option)"
    holds "the help lists names of edit --$option" test -n "$(listed $option)"
done
run bench --help all
for option in format enclose; do
    holds "help and completion of bench --$option differ" \
        test "$(complete_words meshwalk bench --$option '')" == "$(row $option)"
done
holds "tables are completed" test "$(complete_words meshwalk bench paper C | tr '\n' ' ')" == \
    'C1 C2 '
run star --help all
for option in walk start; do
    holds "help and completion of star --$option differ" \
        test "$(complete_words meshwalk star --$option '')" == "$(listed $option)"
    holds "the help lists names of star --$option" test -n "$(listed $option)"
    for name in $(listed $option); do
        holds "meshwalk-star.1 names $name" grep -Eq "^\.Cm .*\<$name\>" \
            "$source_tree/docs/man/meshwalk-star.1"
    done
done
holds "help and completion of star --finish differ" \
    test "$(complete_words meshwalk star --finish '')" == "$(row finish)"
run probe --help all
flat=$(tr -s ' \n' ' ' <"$logs/out")
for words in "--strict exit with 1 if a row is 'limit' or 'bad'" \
    'without --race results do not depend on it' \
    'without --certain another seed may find another triangle'; do
    holds "the help of probe says: $words" test "${flat#*"$words"}" != "$flat"
done
for words in 'a point has no answer' 'where a point lies does not depend'; do
    holds "the help of probe does not say: $words" test "${flat#*"$words"}" == "$flat"
done
holds "help and completion of probe --start differ" \
    test "$(complete_words meshwalk probe --start '')" == "$(listed start)"
run walk --help all
holds "help and completion of walk --walk differ" \
    test "$(complete_words meshwalk walk --walk '')" == "$(listed walk)"
for c in info check walk; do
    run $c --help all
    holds "help and completion of $c --as differ" test "$(complete_words meshwalk $c --as '')" == \
        "$(listed as)"
    holds "the help lists names of --as" test -n "$(listed as)"
done
run sample --help all
holds "help and completion of --outside differ" \
    test "$(complete_words meshwalk sample --outside '')" == "$(listed outside)"
for name in $(complete_words meshwalk triangulate --class ''); do
    run triangulate absent --class "$name" -o b.ply; exits 3
done
for name in $(complete_words meshwalk triangulate --format ''); do
    run triangulate absent --format "$name" -o b.ply; exits 3
done
holds "commands are completed" test "$(complete_words meshwalk lo)" == locate
holds "--walk=st is completed" test "$(complete_words meshwalk locate --walk = st | tr '\n' ' ')" \
    == "stochastic straight "

# Manual pages: sound, and one for each command.
for page in "$source_tree"/docs/man/*.1; do
    if command -v mandoc >/dev/null; then
        holds "$(basename "$page"): $(mandoc -T lint -W warning "$page")" mandoc -T lint -W \
            warning "$page"
    else
        left_out "there is no mandoc"
    fi
done
for c in "${commands[@]}"; do
    holds "meshwalk.1 names $c" grep -q "^.It Cm $c\$" "$source_tree/docs/man/meshwalk.1"
done
finish

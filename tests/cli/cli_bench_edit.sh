#!/usr/bin/env bash
# bench edit: the columns, a row for each engine that takes the task, and all of them have come to
# the same triangulation and the same answers, or the program ends with 4; names that do not exist
# are refused. No peer is needed.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
header=$'task\tdataset\tvertices\tedits\tengine\tns\ttriangles\tbytes\twrong\tratio'
small=(--rounds 2 --format tsv)
scripts=insert,insert-sorted,insert-many,insert-many-sorted,remove,move-near,move-far,mixed
own=meshwalk,meshwalk-layers,meshwalk-grid

# The machine, the names of the columns, and so many rows of ten cells.
sound() { # sound ROWS
    holds "first comes a comment" grep -q '^# ..*; meshwalk [0-9.]*' <(head -n 1 "$logs/out")
    holds "then the names of the columns" test "$(sed -n 2p "$logs/out")" == "$header"
    holds "there are $1 rows, not $(($(wc -l <"$logs/out") - 2))" test "$(wc -l <"$logs/out")" == \
        $(($1 + 2))
    local wrong
    wrong=$(tail -n +3 "$logs/out" | awk -F '\t' '
        function number(s) { return s ~ /^[0-9]+(\.[0-9]+)?$/ }
        NF != 10 || !number($3) || !number($4) || ($6 != "" && !number($6)) ||
        ($5 !~ /embree/ && $9 + 0 != 0) { print }')
    holds "wrong rows: $wrong" test -z "$wrong"
}
column() { tail -n +3 "$logs/out" | cut -f "$1" | sort -u | tr '\n' ' '; }

run bench edit uniform --sizes 300 --tasks $scripts --engines $own "${small[@]}"; exits 0
says_nothing; sound 24
holds "the tasks" test "$(column 1)" == \
    'insert insert-many insert-many-sorted insert-sorted mixed move-far move-near remove '
holds "half as many edits as vertices" test "$(column 2,3,4)" == $'uniform\t300\t150 '
run bench edit clusters,gaussian,arcs,rectangle --sizes 100,1000 --queries 40 --tasks $scripts \
    --engines $own "${small[@]}"
exits 0; says_nothing; sound 192
holds "as many edits as were asked for" test "$(column 4)" == '40 '
run bench edit uniform --sizes 10 --tasks $scripts --engines $own "${small[@]}"; exits 0; sound 24
# Peers that are there take part, those that are not are told.
run bench edit uniform --sizes 2000 --tasks $scripts "${small[@]}" -q; exits 0; says_nothing
# Each engine takes each task, once: three of ours, and the peers that are there.
engines=$(column 5 | wc -w)
holds "three engines of ours" test "$(column 5 | tr ' ' '\n' | grep -c '^meshwalk')" == 3
holds "no row twice" test -z "$(tail -n +3 "$logs/out" | cut -f 1,5 | sort | uniq -d)"
sound $((8 * engines))
run bench edit uniform --sizes 100 --tasks insert,rebuild "${small[@]}"; exits 0
holds "what is missing is told with the way to get it" \
    test -z "$(grep -v '^meshwalk: without .*: .*; on Debian: apt-get install [a-z0-9-]*$' "$logs/err")"

# Strides of 1, 10 and 100 edits, and where they break even.
run bench edit uniform --sizes 300 --tasks rebuild --engines meshwalk,meshwalk-anew "${small[@]}"
exits 0; says_nothing; sound 7
holds "three strides, two of each" \
    test "$(awk -F '\t' '$6 != "" && NR > 2 { printf "%s ", $4 }' "$logs/out")" == \
    '1 1 10 10 100 100 '
# A session: the edits and seven ways to begin, at first and after 3, 30, 300 and 3000 edits, and
# compacted.
run bench edit uniform --sizes 300 --tasks session "${small[@]}"; exits 0; sound 48
holds "its edits" test "$(column 4)" == '0 3 30 300 3000 '
holds "its beginnings" test "$(column 5)" == \
    'auto compact edits grid grid-not-kept-up last layers sample two-level-grid '

run bench edit uniform --sizes 200 --tasks insert --engines meshwalk --rounds 1; exits 0
prints_line '^task +dataset +vertices +edits +engine +ns +triangles +bytes +wrong +ratio$'
prints_line '^insert +uniform +200 +100 +meshwalk +[0-9.]+ *$'

run bench edit --engines meshwalk,cgla
refused 2 "unknown engine 'cgla'; there are meshwalk, .*boost"
run bench edit --tasks randon; refused 2 "unknown task 'randon'; there are insert, .*session$"
run bench edit unifrom; refused 2 "unknown set 'unifrom'; did you mean 'uniform'\?"
run bench edit grid; refused 2 "unknown set 'grid'"
run bench edit --engines meshwalk-anew --tasks insert
refused 2 'none of these engines takes any of these tasks'
run bench edit --sizes 9; refused 2 "'--sizes'"
run bench edit --format json; refused 2 'table or tsv'
run bench edit --no-times; refused 2 'makes its own points'
run bench edit --sizes 1e5 -o absent/x.tsv; exits 4; says 'absent/x.tsv'
finish

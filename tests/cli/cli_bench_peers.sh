#!/usr/bin/env bash
# bench peers, bench scale: the columns, a row for each engine that takes the task, no wrong answer
# of ours; names that do not exist are refused. No peer is needed; where the program was built with
# some, their exact answers are compared, too.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
header=$'task\tdataset\tvertices\tengine\tthreads\tns_per_query\tbuild_s\tbytes\twrong'
small=(--queries 500 --rounds 2 --format tsv)
own=meshwalk,meshwalk-single,meshwalk-grid,meshwalk-grid-single,meshwalk-last

# The machine, the names of the columns, and so many rows of nine cells: numbers, and nothing wrong
# where answers are exact. Without queries there are no nanoseconds for each, and no answers.
sound() { # sound ROWS
    holds "first comes a comment" grep -q '^# ..*; meshwalk [0-9.]*' <(head -n 1 "$logs/out")
    holds "then the names of the columns" test "$(sed -n 2p "$logs/out")" == "$header"
    holds "there are $1 rows, not $(($(wc -l <"$logs/out") - 2))" test "$(wc -l <"$logs/out")" == \
        $(($1 + 2))
    local wrong
    wrong=$(tail -n +3 "$logs/out" | awk -F '\t' '
        function number(s) { return s ~ /^[0-9]+(\.[0-9]+)?$/ }
        NF != 9 || !number($3) || !number($5) || !number($7) || !number($8) { print; next }
        $1 == "delaunay" || $1 == "connectivity" { if ($6 != "" || $9 != "") print; next }
        !number($6) || !number($9) || ($4 !~ /embree|scipy|matplotlib/ && $9 != 0) { print }')
    holds "wrong rows: $wrong" test -z "$wrong"
}
column() { tail -n +3 "$logs/out" | cut -f "$1" | sort -u | tr '\n' ' '; }

# Four of ours take queries in any order, a fifth those in a good one; all do on the points of every
# set.
run bench peers uniform --sizes 300 --engines $own "${small[@]}"; exits 0; says_nothing; sound 22
holds "the tasks" test "$(column 1)" == 'coherent half-outside random sorted total '
holds "the set and its size" test "$(column 2,3)" == $'uniform\t300 '
holds "an engine for streams takes streams only" \
    test "$(awk -F '\t' '$4 == "meshwalk-last" { printf "%s ", $1 }' "$logs/out")" == \
    'sorted coherent '
run bench peers clusters,gaussian,rectangle,slivers,grid,arcs,rings,offset,cadastre,lidar --sizes \
    100,1000 --engines $own "${small[@]}"
exits 0; says_nothing; sound 440
run bench peers uniform --sizes 10 --engines meshwalk --tasks total,dense,delaunay,connectivity \
    "${small[@]}" --queries 1
exits 0; says_nothing; sound 4
# Threads are a row more for those that use them.
run bench peers grid --sizes 1000 --engines meshwalk,meshwalk-single --tasks random,total \
    --threads 2 "${small[@]}"
exits 0; sound 6
holds "one and two threads" test \
    "$(awk -F '\t' '$4 == "meshwalk" { printf "%s ", $5 }' "$logs/out")" == '1 2 1 2 '
# Peers that are missing are passed over with a remark, or without one; those that are there answer,
# and exactly where they say so.
run bench peers uniform --sizes 500 --tasks random,half-outside "${small[@]}" -q; exits 0
says_nothing
# Each engine takes both tasks, once: all of ours but those for streams, and the peers that are
# there. Borrowed arrays are asked for no points outside.
engines=$(column 4 | wc -w)
sound $((2 * engines - 1))
holds "no row twice" test -z "$(tail -n +3 "$logs/out" | cut -f 1,4 | sort | uniq -d)"
holds "nine engines of ours" test "$(column 4 | tr ' ' '\n' | grep -c '^meshwalk')" == 9
run bench peers uniform --sizes 100 --tasks random "${small[@]}"; exits 0
holds "what is missing is told with the way to get it" \
    test -z "$(grep -v '^meshwalk: without .*: .*; on Debian: apt-get install [a-z0-9-]*$' "$logs/err")"
peers=$(awk -F '\t' '$4 ~ /geos/' "$logs/out")
if [[ -z $peers ]]; then
    says '^meshwalk: without GEOS: .*libgeos-dev$'
    run bench peers uniform --engines geos "${small[@]}"; refused 2 'without GEOS: '
fi

# One's own data: points are triangulated, a mesh is taken as it is, with its hole.
printf '0 0\n4 0\n4 3\n0 3\n1 1\n1 1\n3 2\n2 1\n' >p.xyz
printf '%s\n' "$ring" >ring.off
run bench peers --data p.xyz,./ring.off --engines $own "${small[@]}"; exits 0; says_nothing
sound 44
holds "both are named" test "$(column 2,3)" == $'p.xyz\t8 ring.off\t8 '
run bench peers --data "$source_tree/data/jacksboro.csv" --engines meshwalk --tasks random \
    "${small[@]}"
exits 0; sound 1
run bench peers --data absent.xyz "${small[@]}" -q; refused 3 'absent.xyz'
printf '%s\n' "$overlap" >overlap.off
run bench peers --data overlap.off "${small[@]}" -q; refused 3 'overlap.off: '
printf '0 0\n1 1\n2 2\n' >line.xyz
run bench peers --data line.xyz "${small[@]}" -q; refused 3 'line.xyz'
: >empty.xyz
run bench peers --data empty.xyz "${small[@]}" -q; refused 3 'empty.xyz'
printf 'OFF\n3 1 0\n-1e308 0 0\n1e308 0 0\n0 1 0\n3 0 1 2\n' >far.off
run bench peers --data far.off "${small[@]}" -q; refused 3 'far.off: the extent .* too large'
rm overlap.off line.xyz empty.xyz far.off

# The other formats.
run bench peers uniform --sizes 100,200 --queries 100 --rounds 1 --engines meshwalk --tasks \
    random,delaunay
exits 0; says_nothing
prints_line '^task +dataset +vertices +engine +threads +ns_per_query +build_s +bytes +wrong$'
prints_line '^random +uniform +200 +meshwalk +1 +[0-9.]+ +[0-9.]+ +[0-9]+ +0$'
run bench peers uniform --sizes 100 --queries 100 --rounds 1 --engines meshwalk --tasks \
    random,delaunay --format json -o p.json
exits 0; prints ''
holds "the rows are JSON" is_json p.json
holds "two of them" test "$(grep -c '"ns_per_query"' p.json)" == 2
rm p.json

# Over sizes.
run bench scale --sizes 100,1000 "${small[@]}"; exits 0; says_nothing; sound 12
holds "the tasks" test "$(column 1)" == 'connectivity delaunay random '
holds "the sets" test "$(column 2)" == 'clusters uniform '
run bench scale uniform --sizes 100 --engines meshwalk-grid "${small[@]}"; exits 0; sound 1

# Wrong usage, found before any work.
run bench peers --engines meshwalk,embre
refused 2 "unknown engine 'embre'; there are meshwalk, .*matplotlib"
run bench peers --tasks randon
refused 2 "unknown task 'randon'; there are random, sorted, .*connectivity$"
run bench peers unifrom; refused 2 "unknown set 'unifrom'; did you mean 'uniform'\?"
run bench peers uniform,; refused 2 "unknown set ''"
run bench peers --engines meshwalk-last --tasks random
refused 2 'none of these engines takes any of these tasks'
run bench peers --data p.xyz,; refused 2 "'--data' must be files"
run bench peers --data p.xyz -o p.xyz; refused 2 'choose another output'
run bench peers --sizes 9; refused 2 "'--sizes'"
run bench peers --rounds 1001; refused 2 "'--rounds' must be at most 1000"
run bench peers --no-times; refused 2 'leave out --enclose and --no-times'
run bench peers --enclose yes; refused 2 'leave out --enclose and --no-times'
run bench peers --plot x.svg; refused 2 "'meshwalk bench scale'"
run bench paper E2 --engines meshwalk
refused 2 "--engines, --tasks and --rounds are for 'bench peers'"
run bench near-vertices --rounds 2; refused 2 "are for 'bench peers'"
run bench peers --sizes 1e8 --engines meshwalk -o absent/x.tsv; exits 4; says 'absent/x.tsv'

# The plot.
run bench scale --plot x.svg --sizes 100; refused 2 'at least two sizes'
run bench scale --plot x.svg --data p.xyz; refused 2 'at least two sizes'
run bench scale --plot x.svg -o x.svg --sizes 100,200; refused 2 'must go to different files'
run bench scale --plot x.svg --sizes 100,200,400 --engines meshwalk,meshwalk-grid --threads 2 \
    "${small[@]}"
if grep -q 'without Cairo' "$logs/err"; then
    refused 2 'without Cairo'
else
    exits 0; says_nothing; sound 48
    holds "the plot is an SVG" grep -q '<svg' x.svg
    rm x.svg
fi
only_files p.xyz ring.off
finish

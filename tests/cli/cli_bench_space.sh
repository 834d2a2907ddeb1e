#!/usr/bin/env bash
# bench space: a row for each model, size, task, engine and way; no answer of ours is wrong.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
ours=meshwalk,meshwalk-walk,meshwalk-star
run bench space icosahedron,knot --sizes 80,400 --rounds 1 --queries 300 --engines $ours \
    --format tsv; exits 0; says_nothing
holds 'the names of the columns' test "$(head -n 1 "$logs/out")" == \
    $'model\ttriangles\ttask\tengine\tway\tns\tratio\tbytes\tother\tmissed\tinvented'
# Of a star-shaped model 3 rows to build, 5 to cast from the centre in disorder and in order, 3 of
# each other kind of rays, 4 to follow each move; of another one without stars and without rays from
# the centre.
holds 'all rows' test "$(tail -n +2 "$logs/out" | cut -f 1-5 | sort -u | wc -l)" == \
    $((2 * (3 + 2 * 5 + 2 * 3 + 3 * 4) + 2 * (2 + 2 * 3 + 3 * 3)))
holds 'certain answers and stars are right' test -z "$(tail -n +2 "$logs/out" | awk -F '\t' \
    '$3 != "build" && $4 != "meshwalk-walk" && $9 + $10 + $11 > 0')"
holds 'every row has a time' test -z "$(tail -n +2 "$logs/out" | awk -F '\t' '!($6 > 0)')"
trap=$source_tree/data/trap.off
run bench space --data "$trap" --rounds 1 --queries 100 --tasks random,move-one \
    --engines meshwalk; exits 0
prints_line '^trap\.off +[0-9]+ random +meshwalk +single( +[0-9.]+)( +0){3}$'
run bench space cube; refused 2 "unknown model 'cube'"
run bench space --tasks fly; refused 2 "unknown task 'fly'"
run bench space --engines abacus; refused 2 "unknown engine 'abacus'"
run bench space knot --data "$trap"; refused 2 'takes files or makes models'
run bench space --plot a.svg; refused 2 'has no plot'
finish

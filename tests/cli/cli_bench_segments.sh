#!/usr/bin/env bash
# bench segments: a row for each size, length and way; the ways find as many triangles.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
run bench segments --sizes 200,2000 --rounds 1 --queries 300 --format tsv; exits 0; says_nothing
holds 'the names of the columns' test "$(head -n 1 "$logs/out")" == \
    $'vertices\tlength\tway\ttriangles\tns\tns_triangle\tprocessor'
holds 'twelve rows' test "$(tail -n +2 "$logs/out" | cut -f 1-3 | sort -u | wc -l)" == 12
holds 'one number of triangles' test "$(tail -n +2 "$logs/out" | cut -f 1,2,4 | sort -u |
    wc -l)" == 4
holds 'short ones have about ten' test -z \
    "$(awk -F '\t' '$1 == 2000 && $2 == "short" && !($4 > 8 && $4 < 12)' "$logs/out")"
run bench segments --sizes 200 --rounds 1 --queries 50; exits 0
prints_line '^ +200 long +alone( +[0-9.e+-]+){4}$'
run bench segments set; refused 2 'makes its own mesh'
run bench segments --engines geos; refused 2 'makes its own mesh'
run bench segments --sizes x; refused 2 "'--sizes'"
finish

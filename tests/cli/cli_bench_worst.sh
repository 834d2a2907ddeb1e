#!/usr/bin/env bash
# bench worst: a row for each trap and size, columns of numbers, steps wherever a locator answers;
# engines beside it have columns of their own; names that do not exist are refused.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
header=$'trap\tvertices\tbuild_s\tbatch_us\tsingle_us\tsteps\tbytes'
small=(--rounds 1 --queries 200 --format tsv)
column() { tail -n +2 "$logs/out" | cut -f "$1" | sort -u | tr '\n' ' '; }
run bench worst --sizes 200,400 "${small[@]}"; exits 0; says_nothing
holds "the names of the columns" test "$(head -n 1 "$logs/out")" == "$header"
holds "two sizes of each" test -z "$(tail -n +2 "$logs/out" | cut -f 1 | uniq -c | awk '$1 != 2')"
holds "the sizes" test "$(column 2)" == '200 400 '
holds "wrong rows" test -z "$(tail -n +2 "$logs/out" | awk -F '\t' 'NF != 7 || !($3 > 0)')"
holds "locators count" test -z "$(tail -n +2 "$logs/out" | awk -F '\t' '$7 != "" && !($6 >= 1)')"
run bench worst fan,hubs --sizes 300 --rounds 1 --queries 50; exits 0; says_nothing
prints_line '^trap +vertices +build_s +batch_us +single_us +steps +bytes$'
prints_line '^hubs +300( +[0-9.e-]+){5}$'
run bench worst fan,equal-probe --engines meshwalk-single --sizes 300 "${small[@]}"; exits 0
holds "columns of an engine" test "$(head -n 1 "$logs/out")" == \
    "$header"$'\tmeshwalk-single_build_s\tmeshwalk-single_us\tmeshwalk-single_wrong'
holds "its figures" grep -Eq $'^fan(\t[^\t]+){8}\t0$' "$logs/out"
holds "it has no probes" grep -Eq $'^equal-probe.*\t\t\t$' "$logs/out"
run bench worst fam; refused 2 "unknown trap 'fam'; did you mean 'fan'\?"
run bench worst --data x; refused 2 'makes its own meshes'
run bench worst --engines geo; refused 2 "unknown engine 'geo'; there are meshwalk, "
run bench worst --sizes x; refused 2 "'--sizes'"
run bench worst fan --sizes 200 "${small[@]}" -o absent/w.tsv; exits 4; says 'absent/w.tsv'
finish

#!/usr/bin/env bash
# Standard streams that are closed, and outputs that are symbolic links.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
printf '%s\n' "$square" >m.off
printf '0.25 0.5\n' >p.xyz

# Standard input that is closed is no empty input: code 3, and no output.
unread() { # unread ARGUMENTS...
    last="meshwalk $* <&-"
    timeout 60 "$meshwalk" "$@" >"$logs/out" 2>"$logs/err" <&-
    code=$?
    refused 3 'standard input: Bad file descriptor'
    only_files m.off p.xyz
}
unread info -
unread check -
unread locate m.off -
unread locate m.off - -o out.csv
unread locate - p.xyz -o out.csv
unread sample m.off -
unread triangulate - -o out.off
unread triangulate --constraints - -o out.off
unread edit m.off - -o out.off
unread edit - p.xyz -o out.off
unread walk - --from 0.5,0.25 --to 0.25,0.5
unread star - p.xyz
unread probe m.off -

# Where it is not read it may be closed, and all others too: no file takes the place of a stream.
last='meshwalk locate m.off p.xyz -o out.csv <&- >&- 2>&-'
"$meshwalk" locate m.off p.xyz -o out.csv <&- >&- 2>&-
code=$? && : >"$logs/out" && : >"$logs/err"
exits 0
holds "the output is complete" test "$(wc -l <out.csv)" == 2
holds "the inputs are untouched" test "$(<m.off)" == "$square" -a "$(<p.xyz)" == '0.25 0.5'
cp out.csv expected.csv
last='meshwalk locate m.off p.xyz -o out.csv --walk no-such 2>&-'
"$meshwalk" locate m.off p.xyz -o out.csv --walk no-such 2>&-
code=$?
exits 2
holds "the message went into no file" same_text out.csv expected.csv
rm out.csv

# A link to a file that does not exist yet: the file appears, the link stays.
mkdir deep
ln -s deep/real.csv dangling.csv
run locate m.off p.xyz -o dangling.csv; exits 0; says_nothing
holds "the link stays" test "$(readlink dangling.csv)" == deep/real.csv
holds "its target is complete" same_text deep/real.csv expected.csv
holds "and alone" test "$(ls -A deep)" == real.csv
run locate m.off p.xyz -o dangling.csv; exits 0
holds "the link stays the second time" test -L dangling.csv
rm deep/real.csv
run locate m.off absent.xyz -o dangling.csv; exits 3
holds "nothing appears where the program fails" test -z "$(ls -A deep)"
ln -s deep/new.csv out.off
run edit m.off /dev/null -o out.off --changes deep/new.csv --format off
refused 2 'cannot both go to'
rm out.off

# Links that lead nowhere are refused by name.
ln -s one.csv other.csv; ln -s other.csv one.csv
run locate m.off p.xyz -o one.csv; refused 4 'one\.csv: Too many levels of symbolic links'
holds "the links stay" test -L one.csv -a -L other.csv
ln -s nowhere/real.csv lost.csv
run locate m.off p.xyz -o lost.csv; refused 4 'lost\.csv: No such file or directory'
holds "the link stays" test -L lost.csv
finish

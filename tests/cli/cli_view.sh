#!/usr/bin/env bash
# view: the page and what it holds, temporary files, exit codes. web_page opens pages in a browser.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"

cp "$MW_SOURCE/data/trap.off" "$MW_SOURCE/data/trap.csv" .
run view -o page.html trap.off
if grep -q 'built without the page' "$logs/err"; then
    exits 2; says 'clang-14, lld, wasi-libc and libclang-rt-14-dev-wasm32'
    holds "no page is left" test ! -e page.html
    left_out "the page was not built"
    finish
fi
exits 0; says_nothing
holds "the page is whole" grep -q '^</html>' page.html
holds "it holds the mesh" grep -q '{"name": "trap.off"' page.html
holds "it may not use a network" grep -q "default-src 'none'" page.html

mkdir temporary
TMPDIR=$PWD/temporary run view trap.off; exits 0
holds "the name of a temporary file is printed" test -s "$(cat "$logs/out")"
TMPDIR=$PWD/nowhere run view trap.off; exits 4; says 'no temporary file can be made in'
run view -o - trap.off; exits 0
prints_line '^</html>'

# Names do not end the script that holds them.
printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n%s' \
    'property float </script>
element face 1
property list uchar int vertex_indices
end_header
0 0 1
1 0 2
0 1 3
3 0 1 2
' >name.ply
run view -o name.html name.ply; exits 0
holds "a name is quoted" grep -q 'u003c/script>' name.html

run view -o points.html --points trap.csv trap.off; exits 0
holds "the points are there" grep -q '"query": {"name": "trap.csv"' points.html
run view --columns x,y trap.off; exits 2; says 'needs --points'
run view -o trap.off trap.off; exits 2; says 'is both input and output'
run view -o trap.csv --points trap.csv trap.off; exits 2; says 'is both input and output'
run view none.off; exits 3; says 'none.off'
run view --points none.csv trap.off; exits 3; says 'none.csv'
run view -o nowhere/page.html trap.off; exits 4
finish

#!/usr/bin/env bash
# edit --as surface: lines carried out and answered in order, what is refused, and the files that
# tell what changed.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
cat >two.off <<'END'
OFF
6 4 0
0 0 0
1 0 0
2 0 0
0 1 0
1 1 0
2 1 0
3 0 1 3
3 1 4 3
3 1 2 4
3 2 5 4
END

# --- lines ---
edits='# from above
probe 0.25 0.25 1 0 0 -1
"split-triangle" 0
SPLIT-EDGE,1,4,1,0.5,0.25,,
probe 1 0.5 1 0 0 -1 # the new vertex
flip 1 3
undo

probe nan 0 0 0 0 1
'
run_on "$edits" edit --as surface two.off - -o out.off; exits 0; says_nothing
prints 'x,y,z,status,triangle,distance,w0,w1,w2
0.25,0.25,1,hit,0,1,0.5,0.25,0.25
1,0.5,1,hit,1,0.75,0,1,0
nan,0,0,bad,-1,,,,'
run info --as surface out.off; prints_line '^vertices +8$'; prints_line '^triangles +8$'
run_on "$edits" edit --as surface two.off - -o out.off --strict; exits 1

# --- cut, sew, remove, add, collapse, move ---
cat >surgery.txt <<'END'
cut 1 4
sew 1 4 to 6 7
remove-vertex 5
add-vertex 2 1 1
add-triangle 2 8 4
move-vertex 8 2 1 0
collapse 8 4
undo
remove-triangle 0
compact
END
run edit --as surface two.off surgery.txt -o out.off --changes changes.csv --numbers numbers.csv \
    --log log.txt
exits 0; says_nothing; prints ''
holds "changes are as expected" diff - changes.csv <<'END'
line,edit,made,reused,freed,vertices_made,vertices_freed,vertices_moved
1,cut,,2 3,,6 7,,
2,sew,,2 3,,,6 7,
3,remove-vertex,,,3,,5,
4,add-vertex,,,,8,,
5,add-triangle,4,,,,,
6,move-vertex,,,,,,8
7,collapse,,,4,,8,
8,undo,4,,,8,,
9,remove-triangle,,,0,,,
10,compact,,,,,,
END
holds "the surface is as expected" diff - out.off <<'END'
OFF
6 3 0
0 0 0
1 0 0
2 0 0
0 1 0
1 1 0
2 1 0
3 1 4 3
3 1 2 4
3 2 5 4
END
holds "old numbers lead to new ones" test \
    "$(grep -c '^10,' numbers.csv) $(grep '^10,vertex,8,' numbers.csv) $(grep '^10,triangle,4,' numbers.csv)" \
    == "14 10,vertex,8,5 10,triangle,4,2"
run edit --as surface two.off log.txt -o again.off --quiet; exits 0
holds "the log makes the same" cmp out.off again.off

# --- what is refused ---
refused() { # message, lines
    run_on "$2" edit --as surface two.off - -o never.off; exits 3; says "$1"
    holds "nothing is written" test ! -e never.off
}
refused 'standard input:1: flip: no edge joins the vertices 0 and 4' $'flip 0 4\n'
refused "standard input:2: unknown edit 'locate'; known edits are add-vertex" $'\nlocate 1 1\n'
refused 'standard input:1: sew: the word .to. and the other chain are missing' $'sew 0 1 3 4\n'
refused 'standard input:1: sew: both chains need the same number of vertices' $'sew 0 1 to 3\n'
refused 'standard input:1: cut: a cut needs at least two vertices' $'cut 1\n'
refused 'standard input:1: split-edge: the y is missing' $'split-edge 0 1 7\n'
refused "standard input:1: flip: '7' is one word too many" $'flip 0 1 7\n'
refused 'standard input:1: remove-triangle: there is no triangle 4' $'remove-triangle 4\n'
refused 'standard input:1: undo: there is no edit to undo' $'undo\n'
run_on $'flip 0 4\nflip 1 4\nflip 1 3\n' edit --as surface two.off - -o out.off --skip --stats
exits 0; says 'standard input:1: flip: no edge joins'; says '^skipped +1$'; says '^flip +2$'
run edit --as surface two.off surgery.txt -o out.off --heights; exits 2
says "option '--heights' needs --as plane"
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 1\n' >bad.off
run edit --as surface bad.off surgery.txt -o never.off; exits 3
says 'triangle 0: vertex 1 is in it twice'; says 'check --as surface'
finish

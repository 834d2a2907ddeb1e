#!/usr/bin/env bash
# locate: answers, in order, the same for every walk, start and number of threads; forms of input;
# statistics.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
header=x,y,status,triangle,w0,w1,w2
printf '%s\n' "$square" >square.off
printf '%s\n' "$ring" >ring.off
printf '%s\n' "$overlap" >overlap.off

points='0.75 0.25
0.25 0.75
0.5 0.5
0 0
1 1
0 1
0 0.5
2 2
nan 1
-0.0 1
1e300 -1e300
'
answers="$header
0.75,0.25,inside,0,0.25,0.5,0.25
0.25,0.75,inside,1,0.25,0.25,0.5
0.5,0.5,edge,0,0.5,0,0.5
0,0,vertex,0,1,0,0
1,1,vertex,0,0,0,1
0,1,vertex,1,0,0,1
0,0.5,edge,1,0.5,0,0.5
2,2,outside,-1,,,
nan,1,bad,-1,,,
-0.0,1,vertex,1,0,0,1
1e300,-1e300,outside,-1,,,"
run_on "$points" locate square.off -; exits 0; says_nothing
prints "$answers"

# Whatever the walk, the start, the arithmetic, the threads and the seed.
names() { # names OPTION: as the help lists them
    "$meshwalk" locate --help all | sed -nE "/ --$1 NAME/,/^ {0,6}-/p" |
        sed -nE 's/^ {26}.([a-z-]+). .*/\1/p'
}
walks=$(names walk) starts=$(names start)
holds "there are walks" test "$(wc -w <<<"$walks")" -ge 5
for walk in $walks; do
    for start in $starts; do
        run_on "$points" locate --walk "$walk" --start "$start" square.off -; exits 0
        prints "$answers"
    done
    run_on "$points" locate --walk "$walk" --arithmetic double --threads 3 --seed 7 square.off -
    exits 0; prints "$answers"
done
# Whatever adjusts them, too; what is out of range is refused before anything is printed.
for options in '--start grid --cells 1' '--start grid --cells 1000' \
    '--start two-level-grid --cells 3' \
    '--start buckets --cells 7' '--start triangle-buckets --cells 5' '--start kd-tree' \
    '--start layers --layers 1' '--start layers --layers 2' \
    '--start layers --layers 3 --descent nearest' \
    '--start layers --layers 3 --descent coordinate' \
    '--walk direct --start layers --descent coordinate' \
    '--start sample --sample 1' \
    '--start sample --sample cube-root' '--start sample --sample fourth-root' \
    '--finish remembering' \
    '--finish stochastic' '--areas' '--steps 1'; do
    # shellcheck disable=SC2086 # words
    run_on "$points" locate $options square.off -; exits 0; prints "$answers"
done
for cells in 1073741825 4000000000; do
    run locate --start grid --cells $cells absent.off -
    refused 2 "'--cells' must be at most 2\^30, not '$cells'"
done
run locate --start layers --layers 9 absent.off -; refused 2 "'--layers' must be at most 8, not '9'"
run_on "$points" locate --start layers --layers 8 square.off -; exits 0; prints "$answers"
run_on "$(cat square.off)" locate - <(printf '%s' "$points"); exits 0; prints "$answers"

# Holes, tolerance, details.
queries='1.5 1.5
1.5 1.25
0.5 0.5
5 1.5
'
run_on "$queries" locate --details ring.off -; exits 0
prints "$header,local,border_triangle,border_edge,distance,hole
1.5,1.5,hole,-1,,,,,1,1,0.5,0
1.5,1.25,hole,-1,,,,,1,1,0.25,0
0.5,0.5,edge,1,0.5,0,0.5,2,,,,
5,1.5,outside,-1,,,,,2,0,2,"
run_on "$queries" locate --tolerance 0.25 ring.off -; exits 0
prints "$header
1.5,1.5,hole,-1,,,
1.5,1.25,near,1,0,0.5,0.5
0.5,0.5,edge,1,0.5,0,0.5
5,1.5,outside,-1,,,"
run_on "$queries" locate --tolerance 2 --details ring.off -; exits 0
prints_line '^5,1.5,near,2,0.5,0.5,0,0,2,0,2,$'
prints_line '^1.5,1.25,near,1,0,0.5,0.5,1,1,1,0.25,0$'

# --strict: 1 where a point has no triangle; the output is complete all the same.
run_on "$points" locate --strict square.off -; exits 1; prints "$answers"; says_nothing
run_on $'0.5 0.5\n' locate --strict square.off -; exits 0
run_on $'1.5 0.5\n' locate --strict --tolerance 0.5 square.off -; exits 0
run_on $'1.5 0.5\n' locate --strict --tolerance 0.25 square.off -; exits 1

# Points in other clothes: BOM, CRLF, header, separators, columns by name and number, a third
# column, blank lines.
inside="$header
0.75,0.25,inside,0,0.25,0.5,0.25
0.25,0.75,inside,1,0.25,0.25,0.5"
for input in $'0.75,0.25\n0.25,0.75' $'\xef\xbb\xbfx,y\r\n0.75,0.25\r\n0.25,0.75\r\n' \
    $'0.75;0.25\n0.25;0.75\n' \
    $'0.75\t0.25\n0.25\t0.75\n' $'  0.75   0.25 \n\n0.25 0.75\n' \
    $'x y z\n0.75 0.25 9\n0.25 0.75 9\n' \
    $'+7.5e-1 2.5E-1\n.25 .75\n'; do
    run_on "$input" locate --only-answers square.off -; exits 0; prints "$inside"
done
table=$'name,lat,lon\na,0.25,0.75\nb,0.75,0.25\n'
run_on "$table" locate --only-answers --columns lon,lat square.off -; exits 0; prints "$inside"
run_on "$table" locate --only-answers --columns 3,2 square.off -; exits 0; prints "$inside"
run_on $'1,2,3\n' locate --columns 1,2,3 square.off -
refused 2 "'--columns' must name 2 columns, x,y, not 3"
run_on "$table" locate --columns lon,height square.off -; refused 3 "no column 'height'"
gzip -c square.off >zipped.off.gz
run_on $'0.75 0.25\n0.25 0.75\n' locate zipped.off.gz -; exits 0; prints "$inside"

# Points that are none: the line is named, and no output is left.
printf '0.5 0.5\n0,5 oops\n' >bad.xyz
run locate square.off bad.xyz -o out.csv; refused 3 'bad\.xyz:2: '; absent out.csv
printf '0,5 0,5\n0,25 0,5\n' >comma.csv
run locate square.off comma.csv -o out.csv; refused 3 'comma\.csv:1: the row has decimal commas'; absent out.csv
run_on $'0,75;0,25\n0,25;0,75\n' locate --only-answers square.off -; exits 0; prints "$inside"
run_on $'0.75;0,25\n' locate square.off -; refused 3 'standard input:1: '
printf '1\n2\n' >one.csv
run locate square.off one.csv -o out.csv; refused 3 'one\.csv'; absent out.csv
: >empty.csv
run locate square.off empty.csv; exits 0; prints "$header"
run locate square.off missing.xyz; refused 3 'missing\.xyz: .*No such file'
run locate square.off .; refused 3 '\.: Is a directory'

# A mesh that is no embedding.
run_on $'0.2 0.2\n5 5\n' locate overlap.off -; refused 3 'overlap\.off'
says "'meshwalk check overlap.off'.*--any"
run_on $'0.2 0.2\n5 5\n' locate --any overlap.off -; exits 0
says 'overlap\.off: warning: .*not an embedding'
prints_line '^0.2,0.2,inside,[01],'
prints_line '^5,5,(outside|hole),-1,,,$'
run_on $'0.2 0.2\n' locate --any --quiet overlap.off -; exits 0; says_nothing
# A fold: whatever walk comes over it, a triangle that is reported contains the point.
printf 'OFF\n5 3 0\n0 0 0\n2 0 0\n0 2 0\n1 1.5 0\n2 2 0\n3 0 1 2\n3 0 1 3\n3 1 4 2\n' >fold.off
awk 'BEGIN { for (i = 0; i < 400; i++) print (i % 20) / 7 - 0.3, int(i / 20) / 7 - 0.3 }' >grid.xyz
for walk in $walks; do
    for start in $starts; do
        run locate --any -q --walk "$walk" --start "$start" fold.off grid.xyz; exits 0
        holds "no weight is negative" test -z \
            "$(grep -E ',-[0-9.e-]+(,|$)' <(cut -d, -f5- "$logs/out"))"
    done
done
# Points in the place of a mesh.
printf '0 0\n1 0\n0 1\n' >points.xyz
run locate points.xyz points.xyz; refused 3 'points\.xyz'
says "'meshwalk triangulate points.xyz -o MESH'"

# Statistics: on standard error, and sums that agree.
run_on "$points" locate --stats square.off -; exits 0; prints "$answers"
says '^points +11$'; says '^inside +2$'; says '^edge +2$'; says '^vertex +4$'; says '^outside +2$'
says '^bad +1$'
says '^queries per second +[0-9]+$'; says '^seed +0$'
run_on "$points" locate --stats --json --seed 5 --walk lawson square.off -; exits 0
prints "$answers"
holds "the statistics are JSON" is_json "$logs/err"
says '"seed": 5'; says '"walk": "lawson"'; says '"triangles_per_query": [1-9]'

# Most points outside: a remark compares the extents and says what it suspects.
printf '%s\n' OFF '4 2 0' '500000 4000000 0' '501000 4000000 0' '501000 4001000 0' \
    '500000 4001000 0' '3 0 1 2' '3 0 2 3' >utm.off
says_remark() { exits 0; says \
    "standard input: remark: $1 points lie outside of [a-z]+\.off: the points have x from .*; the mesh has x from .*$2\$"
    }
run_on $'-123 44\n' locate utm.off -
says_remark '1 of 1' 'to 4001000; the points look like degrees, the mesh does not'
says 'the points have x from -123 to -123, y from 44 to 44; the mesh has x from 500000 to 501000, y from 4000000 to '
run_on $'4000500,500500\nNA,1\n' locate utm.off -
says_remark '1 of 1' '; with x and y exchanged they would meet: --columns .*'
run_on $'1640500,13123500\n' locate utm.off -
says_remark '1 of 1' '; they would meet if the points were in feet and the mesh in metres'
run_on $'152500,1219300\n' locate utm.off -
says_remark '1 of 1' '; they would meet if the points were in metres and the mesh in feet'
run_on $'500500,4000500\n' locate square.off -
says_remark '1 of 1' '; the mesh looks like degrees, the points do not'
run_on $'500500,4000500\n-123 44\n' locate -q utm.off -; exits 3
run_on $'-123 44\n' locate -q utm.off -; exits 0; says_nothing
run_on $'-123 44\n' locate --strict utm.off -; exits 1; says remark
run_on $'-123 44\n500500 4000500\n' locate utm.off -; exits 0; says_nothing
# a few may well be somewhere else
run_on $'700000 4000000\n' locate utm.off -; exits 0; says_nothing
run_on "$(yes '700000 4000000' | head -n 10)"$'\n' locate utm.off -
says_remark '10 of 10' 'y from 4000000 to 4001000'
printf '%s\n' OFF '3 1 0' '-150 0 0' '-140 0 0' '-145 9 0' '3 0 1 2' >west.off
run_on "$(yes '215 1' | head -n 10)"$'\n' locate west.off -
says_remark '10 of 10' '; with 360 degrees less in x they would meet'
printf '%s\n' OFF '3 1 0' '210 0 0' '220 0 0' '215 9 0' '3 0 1 2' >east.off
run_on "$(yes -- '-145,1' | head -n 10)"$'\n' sample east.off -
says_remark '10 of 10' '; with 360 degrees more in x they would meet'
run_on $'nan nan\n' locate utm.off -; exits 0; says_nothing
# A mesh of longitudes across 180 degrees.
awk 'BEGIN { print "OFF"; print 22, 20, 0
    for (i = 0; i < 11; i++) for (j = 0; j < 2; j++) print (i < 10 ? 160 + 2 * i : -179), 10 + j, 0
    for (i = 0; i < 10; i++) { print 3, 2*i, 2*i+2, 2*i+3; print 3, 2*i, 2*i+3, 2*i+1 } }' >seam.off
run_on $'165 10.5\n' locate --any seam.off -
says "seam\.off: warning: 2 of its triangles are wider than 180 degrees: .*'meshwalk star --lonlat'"

# Memory and time of what the start and the walks build; nothing where nothing is built.
for start in grid buckets triangle-buckets two-level-grid layers kd-tree; do
    run_on "$points" locate --stats --start $start --areas square.off -; exits 0
    says '^start bytes +[1-9]'; says '^start seconds +[0-9]'; says '^area bytes +16$'
    says "^start +$start\$"
done
run_on "$points" locate --stats square.off -; exits 0
says '^start bytes +0$'; says '^area bytes +0$'

# More points than one block holds; the output does not depend on the threads, and its rows are in
# order.
awk 'BEGIN { for (i = 0; i < 300000; i++) printf "%d.%d,%.3f\n", i % 3, i % 7, (i % 1001) / 400 }' \
    >many.csv
run locate --threads 1 ring.off many.csv -o one.csv; exits 0
run locate --threads 2 ring.off many.csv -o two.csv; exits 0
holds "one thread and two print the same" same_text one.csv two.csv
holds "there is a row for each point" test "$(wc -l <two.csv)" == 300001
paste -d, many.csv <(tail -n +2 two.csv) | awk -F, '$1 != $3 || $2 != $4 { exit 1 }'
holds "the rows are in the order of the points" test "${PIPESTATUS[*]}" == "0 0"

# Threads: no more than there is work for; a system that refuses them is not mistaken for points
# without an answer. (A sanitizer takes so much address space that nothing runs below such limits.)
if (ulimit -v 250000; "$meshwalk" --version) >/dev/null 2>&1; then
    last='meshwalk locate --threads 256, one point, with little memory'
    echo '0.5 0.25' | (ulimit -v 200000; exec "$meshwalk" locate --threads 256 square.off -) \
        >"$logs/out" 2>"$logs/err"
    code=${PIPESTATUS[1]}
    exits 0; says_nothing; prints_line '^0\.5,0\.25,inside,0,'
    for kilobytes in 60000 200000 1000000; do
        last="meshwalk locate --threads 256, many points, with $kilobytes kB of memory"
        (ulimit -v $kilobytes; exec "$meshwalk" locate --threads 256 ring.off many.csv -o few.csv) \
            >"$logs/out" 2>"$logs/err"
        code=$?
        holds "all is done, or the code is 4 and no file is left" \
            test "$code $(wc -l 2>/dev/null <few.csv)" == '0 300001' -o \
            "$code $(ls few.csv 2>/dev/null)" == '4 '
        rm -f few.csv
    done
fi
# Faces of a file that are no triangles have a column, and numbers are the file's on request.
printf 'quads\n2 6\n1 0 0 5\n2 1 0 5\n3 1 1 5\n4 0 1 5\n5 2 0 5\n6 2 1 5\n%s\n' \
    '1 4 1 2 3 4
2 4 2 5 6 3' >quads.gr3
run_on $'0.75 0.25\n1.75 0.5\n9 9\n' locate quads.gr3 -; exits 0; says_nothing
prints 'x,y,status,triangle,face,w0,w1,w2
0.75,0.25,inside,0,0,0.25,0.5,0.25
1.75,0.5,inside,2,1,0.25,0.25,0.5
9,9,outside,-1,,,,'
run_on $'0.75 0.25\n1.75 0.5\n9 9\n' locate --base file --details quads.gr3 -; exits 0
prints 'x,y,status,triangle,face,w0,w1,w2,local,border_triangle,border_edge,distance,hole
0.75,0.25,inside,1,1,0.25,0.5,0.25,,,,,
1.75,0.5,inside,3,2,0.25,0.25,0.5,,,,,
9,9,outside,-1,,,,,,3,1,10.63014581273465,'
run_on $'0.75 0.25\n' locate --base 1 square.off -; exits 0
prints 'x,y,status,triangle,w0,w1,w2
0.75,0.25,inside,1,0.25,0.5,0.25'
run_on $'0.75 0.25\n' locate --base file square.off -; exits 0
prints 'x,y,status,triangle,w0,w1,w2
0.75,0.25,inside,0,0.25,0.5,0.25'
run_on $'0 0\n' locate --base 1 --polygons square.geojson -; exits 2
says '--base is for MESH'
finish

#!/usr/bin/env bash
# star: facets that rays meet, on polyhedra small enough to know the answers; poles, seam, centres;
# what is refused.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
header=x,y,z,status,triangle,w0,w1,w2
sphere_header=lon,lat,status,triangle,w0,w1,w2

# An octahedron: facets 0 to 3 above, 4 to 7 below; vertices on the axes.
octahedron='OFF
6 8 0
1 0 0
0 1 0
-1 0 0
0 -1 0
0 0 1
0 0 -1
3 0 1 4
3 1 2 4
3 2 3 4
3 3 0 4
3 1 0 5
3 2 1 5
3 3 2 5
3 0 3 5'
printf '%s\n' "$octahedron" >octahedron.off
points='1 1 2
-1 1 2
-1 -1 2
1 -1 2
1 1 -2
-3 -1 -4
1 0 0
0 0 -7
0 5 0
1 1 0
0 1 1
-2 0 -2
0 0 0
nan 1 1
1 0 -inf
1e300 1e300 0
1e-300 0 0
'
answers="$header
1,1,2,inside,0,0.25,0.25,0.5
-1,1,2,inside,1,0.25,0.25,0.5
-1,-1,2,inside,2,0.25,0.25,0.5
1,-1,2,inside,3,0.25,0.25,0.5
1,1,-2,inside,4,0.25,0.25,0.5
-3,-1,-4,inside,6,0.125,0.375,0.5
1,0,0,vertex,0,1,0,0
0,0,-7,vertex,4,0,0,1
0,5,0,vertex,0,0,1,0
1,1,0,edge,0,0.5,0.5,0
0,1,1,edge,0,0,0.5,0.5
-2,0,-2,edge,5,0.5,0,0.5
0,0,0,bad,-1,,,
nan,1,1,bad,-1,,,
1,0,-inf,bad,-1,,,
1e300,1e300,0,edge,0,0.5,0.5,0
1e-300,0,0,vertex,0,1,0,0"
run_on "$points" star octahedron.off -; exits 0; says_nothing
prints "$answers"

# Whatever the walk, the start, the threads and the seed.
names() { # names OPTION: as the help lists them
    "$meshwalk" star --help all | sed -nE "/ --$1 NAME/,/^ {0,6}-/p" |
        sed -nE 's/^ {26}.([a-z-]+). .*/\1/p'
}
walks=$(names walk) starts=$(names start)
holds "there are walks and starts" test "$(wc -w <<<"$walks $starts")" -ge 12
for walk in $walks; do
    for start in $starts; do
        run_on "$points" star --walk "$walk" --start "$start" octahedron.off -; exits 0
        prints "$answers"
    done
    run_on "$points" star --walk "$walk" --threads 3 --seed 7 octahedron.off -; exits 0
    prints "$answers"
done
for options in '--finish auto' '--finish stochastic' '--finish forgetful' \
    '--walk orthogonal --finish auto' \
    '--walk orthogonal --finish stochastic' '--walk orthogonal --finish forgetful' \
    '--start grid --cells 1' '--start grid --cells 1000' '--start nonuniform-grid --cells 3' \
    '--start octahedron --levels 1' '--start octahedron --levels 5' '--start sample --sample 1' \
    '--borrow' '--borrow --start last' '--borrow --walk stochastic --start random'; do
    # shellcheck disable=SC2086 # words
    run_on "$points" star $options octahedron.off -; exits 0; prints "$answers"
done
run_on "$(cat octahedron.off)" star - <(printf '%s' "$points"); exits 0; prints "$answers"

# --strict: 1 where a row is bad; the output is complete all the same.
run_on "$points" star --strict octahedron.off -; exits 1; prints "$answers"; says_nothing
run_on $'1 2 3\n' star --strict octahedron.off -; exits 0

# Longitude and latitude: poles, whatever the longitude; the seam from both sides; full turns.
sphere='0 0
90 0
180 0
-180 0
-90 0
270 0
540 0
10 90
-180 90
180 -90
0 -90
nan 0
0 90.5
0 -91
inf 0
'
sphere_answers="$sphere_header
0,0,vertex,0,1,0,0
90,0,vertex,0,0,1,0
180,0,vertex,1,0,1,0
-180,0,vertex,1,0,1,0
-90,0,vertex,2,0,1,0
270,0,vertex,2,0,1,0
540,0,vertex,1,0,1,0
10,90,vertex,0,0,0,1
-180,90,vertex,0,0,0,1
180,-90,vertex,4,0,0,1
0,-90,vertex,4,0,0,1
nan,0,bad,-1,,,
0,90.5,bad,-1,,,
0,-91,bad,-1,,,
inf,0,bad,-1,,,"
for walk in $walks; do
    run_on "$sphere" star --lonlat --walk "$walk" octahedron.off -; exits 0
    prints "$sphere_answers"
done
run_on $'180 45\n-180 45\n45 0\n45 10\n-135 -10\n' star --lonlat octahedron.off -; exits 0
prints_line '^180,45,edge,1,0,0\.5[0-9]*,0\.(5|4999)[0-9]*$'; prints_line '^-180,45,edge,1,0,0\.5'
prints_line '^45,0,edge,0,0\.(5|4999)[0-9]*,0\.(5|4999)[0-9]*,0$'
prints_line '^45,10,inside,0,'; prints_line '^-135,-10,inside,6,'
# Columns: what a header calls so, in any order; by name and by number.
for input in $'lon,lat\n10,90' $'lat,lon\n90,10' $'id;latitude;longitude\n7;90;10' \
    $'Lat (deg),LNG\n90,10'; do
    run_on "$input"$'\n' star --lonlat --only-answers octahedron.off -; exits 0
    prints "$sphere_header"$'\n'10,90,vertex,0,0,0,1
done
run_on $'a,b,c\n90,0,10\n' star --lonlat --columns c,a octahedron.off -; exits 0
prints $'a,b,c,status,triangle,w0,w1,w2\n90,0,10,vertex,0,0,0,1'
for input in $'z,y,x\n2,1,-1' $'id,X,Y,Z\n9,-1,1,2' $'-1 1 2' $'x,y,z,lon,lat\n-1,1,2,0,0' \
    $'u,v,w\n-1,1,2'; do
    run_on "$input"$'\n' star --only-answers octahedron.off -; exits 0
    prints "$header"$'\n'-1,1,2,inside,1,0.25,0.25,0.5
done
run_on $'a,b,c,d\n5,-1,1,2\n' star --columns b,c,d octahedron.off -; exits 0
prints_line '^5,-1,1,2,inside,1,'
run_on $'a,b,c,d\n5,-1,1,2\n' star --columns 2,3,4 octahedron.off -; exits 0
prints_line '^5,-1,1,2,inside,1,'
run_on $'a,b,c,d\n5,-1,1,2\n' star octahedron.off - -o o.csv; exits 2
says 'standard input: which of its 4 columns are x,y,z\?'
run_on $'-1 1 2 77\n' star octahedron.off - -o o.csv
refused 2 'which of its 4 columns are x,y,z\? They have no names'
run_on $'10 90 5\n' star --lonlat octahedron.off - -o o.csv
refused 2 'which of its 3 columns are lon,lat\?'
run_on $'lon,lat,height\n5,1,2\n' star octahedron.off - -o o.csv
refused 2 '; --lonlat reads longitude and latitude'
run_on $'5,1\n' star octahedron.off - -o o.csv; exits 3
says 'has 2 columns, but a row is x,y,z; --lonlat'
run_on $'a,b,c,d\n5,-1,1,2\n' star --columns a,b octahedron.off -
refused 2 "'--columns' must name 3 columns, x,y,z, not 2"
for list in 1,2,3 c,a,b; do
    run_on $'a,b,c,d\n90,0,10,2\n' star --lonlat --columns $list octahedron.off -
    refused 2 "'--columns' must name 2 columns, lon,lat, not 3"
done
run_on $'a,b,c,d\n5,-1,1,2\n' star --columns 1,2,3,4 octahedron.off -
refused 2 "'--columns' must name 3 columns, x,y,z, not 4"
run_on $'a,b,c,d\n5,-1,1,2\n' star --columns a,b,e octahedron.off -; refused 3 "no column 'e'"
absent o.csv

# A grid of longitudes and latitudes: a seam at 180 degrees, rows of vertices at the poles, and no
# z. Facets without area at the poles own nothing. Vertices 0 to 4 south, 5 to 9 on the equator, 10
# to 14 north.
awk 'BEGIN { print 15, 2, 0, 0; for (i = 0; i < 15; i++) print i, (i % 5) * 90 - 180, int(i / 5) * 90 - 90 }' >globe.node
awk 'BEGIN { print 16, 3, 0
    for (i = 0; i < 4; i++) { print 2*i, i, i+1, i+6; print 2*i+1, i, i+6, i+5 }
    for (i = 0; i < 4; i++) { print 8+2*i, i+5, i+6, i+11;
    print 9+2*i, i+5, i+11, i+10 } }' >globe.ele
for walk in $walks; do
    run_on "$sphere" star --lonlat --walk "$walk" globe.node -; exits 0; says_nothing
    prints "$sphere_header
0,0,vertex,3,0,1,0
90,0,vertex,5,0,1,0
180,0,vertex,1,0,0,1
-180,0,vertex,1,0,0,1
-90,0,vertex,1,0,1,0
270,0,vertex,1,0,1,0
540,0,vertex,1,0,0,1
10,90,vertex,8,0,0,1
-180,90,vertex,8,0,0,1
180,-90,vertex,1,1,0,0
0,-90,vertex,1,1,0,0
nan,0,bad,-1,,,
0,90.5,bad,-1,,,
0,-91,bad,-1,,,
inf,0,bad,-1,,,"
done
run_on $'180 45\n-180 45\n45 45\n45 0\n' star --lonlat globe -; exits 0
prints_line '^180,45,edge,8,0\.(5|4999)[0-9]*,0,0\.(5|4999)[0-9]*$'; prints_line '^-180,45,edge,8,'
prints_line '^45,45,inside,12,'; prints_line '^45,0,edge,5,0,'
run_on $'1 2 3\n' star globe.node -; refused 3 'globe\.node: '
says 'has no z; --lonlat takes x and y as longitude'
sed 's/^7 .*/7 0 91/' globe.node >far.node; cp globe.ele far.ele
run_on $'1 2\n' star --lonlat far.node -
refused 3 'far\.node: vertex 7: 0, 91 are not a longitude and a latitude'

# Facets of mixed orientation; weights are those of the corners as the file has them.
sed 's/^3 0 1 4$/3 1 0 4/; s/^3 3 2 5$/3 3 5 2/' octahedron.off >mixed.off
run_on $'1 2 3\n0 0 1\n-1 -2 -5\n' star mixed.off -; exits 0
prints_line '^1,2,3,inside,0,0\.333333333333333[0-9]*,0\.166666666666666[0-9]*,0\.5$'
prints_line '^0,0,1,vertex,0,0,0,1$'; prints_line '^-1,-2,-5,inside,6,0\.25,0\.625,0\.125$'

# Other centres. A cube sees all of its facets from inside, not from a corner or outside.
moved() { # moved X Y Z: the octahedron there
    awk -v x="$1" -v y="$2" -v z="$3" 'NR > 2 && NR < 9 { $1 += x; $2 += y; $3 += z } { print }' \
        OFMT=%.17g octahedron.off
}
moved 5 -6 7 >moved.off
run_on $'6 -5 9\n5 -6 0\n5 -6 7\n' star --centre 5,-6,7 moved.off -; exits 0
prints "$header
6,-5,9,inside,0,0.25,0.25,0.5
5,-6,0,vertex,4,0,0,1
5,-6,7,bad,-1,,,"
run_on "$sphere" star --centre=5,-6,7 --lonlat moved.off -; exits 0; prints "$sphere_answers"
moved 3e6 5e6 0 >far.off
run_on "$sphere" star --centre 3e6,5e6,0 --lonlat far.off -; exits 0; prints "$sphere_answers"
run_on $'45 35.26\n' star --centre 3e6,5e6,0 --lonlat far.off -; exits 0
prints_line '^45,35\.26,inside,0,0\.333[0-9]*,0\.333[0-9]*,0\.333[0-9]*$'
run_on $'1 2 3\n' star moved.off - -o o.csv; refused 3 'moved\.off: triangle [0-7]: '
says "'meshwalk check --as star moved\.off' lists every defect, 'meshwalk view' shows it"; absent o.csv
run_on $'1 2 3\n' star --centre 9,0,0.5 octahedron.off -
refused 3 'octahedron\.off: triangle [0-7]: '
says "'meshwalk check --as star --centre 9,0,0.5 octahedron\.off'"
# Beyond an edge of a tetrahedron two facets face the centre and two face away: these are named.
printf '%s\n' OFF '4 4 0' '0 0 0' '4 0 0' '0 4 0' '0 0 4' '3 0 2 1' '3 0 1 3' '3 0 3 2' '3 1 2 3' \
    >four.off
run check --as star --centre=-1,-1,1 four.off; exits 3
prints 'triangle 1: faces away from the centre, unlike triangle 0 at edge 0
triangle 2: faces away from the centre, unlike triangle 3 at edge 1
four.off: not star-shaped about the centre: 2 defects'
rm four.off
run_on $'1 2 3\n' star --centre 1,0,0 octahedron.off -; refused 3 'triangle [0-7]: .*centre'
sed 's/^6 8 0/6 7 0/; $d' octahedron.off >open.off
run_on $'1 2 3\n' star open.off -; refused 3 'open\.off: triangle [0-7]: .*not closed'

# Files that are none, or not of the kind wanted.
run star missing.off p.xyz; refused 3 'missing\.off: .*No such file'
run star octahedron.off missing.xyz; refused 3 'missing\.xyz: .*No such file'
run star octahedron.off octahedron.off; exits 3; says '^meshwalk: octahedron\.off:'
printf '0 0 1\n1 0 1\n0 1 1\n' >points.xyz
run star points.xyz points.xyz; refused 3 'points\.xyz: holds points'
printf '%s\n' "$square" >square.off
run star square.off points.xyz; refused 3 'square\.off: triangle [01]: '
run star octahedron.off octahedron.off -o octahedron.off; refused 2 'is both input and output'
printf '0 0 1\n1 x 1\n' >bad.xyz
run star octahedron.off bad.xyz -o o.csv; refused 3 'bad\.xyz:2: '; absent o.csv
: >empty.csv
run star octahedron.off empty.csv; exits 0; prints "$header"

# Output that cannot be written.
last='meshwalk star octahedron.off points.xyz >&-'
"$meshwalk" star octahedron.off points.xyz >&- 2>"$logs/err"
code=$? && : >"$logs/out"
exits 4; says '^meshwalk: '
if [[ -w /dev/full ]]; then
    run star octahedron.off points.xyz -o /dev/full; exits 4; says 'No space left on device'
fi

# Statistics.
run_on "$points" star --stats --walk straight --start grid octahedron.off -; exits 0
prints "$answers"
says '^points +17$'; says '^inside +6$'; says '^edge +4$'; says '^vertex +4$'; says '^bad +3$'
says '^walk +straight$'
says '^start +grid$'; says '^start bytes +[1-9]'; says '^surface bytes +[1-9]'
says '^triangles per query +[1-9]'
says '^angle bytes +0$'
run_on "$points" star --stats --json --walk orthogonal octahedron.off -; exits 0; prints "$answers"
holds "the statistics are JSON" is_json "$logs/err"
says '"angle_bytes": 96'; says '"walk": "orthogonal"'

# Without memory: the same answers; other walks and starts are refused.
run_on "$points" star --borrow --stats octahedron.off -; exits 0; prints "$answers"
says '^star bytes +[1-4][0-9][0-9]$'
run star --borrow --walk straight octahedron.off points.xyz
refused 2 'the walk on a borrowed star is stochastic, not straight'
run star --borrow --start grid octahedron.off points.xyz; refused 2 'a borrowed star has no index'
run star --borrow --start front octahedron.off points.xyz; refused 2 'the starts on a borrowed star'
run star --borrow --remesh 2 octahedron.off -o o.off; refused 2 "'--borrow' is for DIRECTIONS"

# More rays than one block holds: in order, and the same for any number of threads.
awk 'BEGIN { for (i = 0; i < 300000; i++)
    printf "%.3f,%.3f\n",
    (i * 7919) % 360000 / 1000 - 180, (i * 104729) % 180000 / 1000 - 90 }' >many.csv
run star --lonlat --threads 1 globe.node many.csv -o one.csv; exits 0
run star --lonlat --threads 2 globe.node many.csv -o two.csv; exits 0
holds "one thread and two print the same" same_text one.csv two.csv
run star --lonlat --borrow globe.node many.csv -o borrowed.csv; exits 0
holds "a borrowed star gives the same answers" same_text one.csv borrowed.csv
paste -d, many.csv <(tail -n +2 two.csv) |
    awk -F, '$1 != $3 || $2 != $4 || $5 == "bad" { exit 1 } END { if (NR != 300000) exit 1 }'
holds "there is a row for each, in order" test "${PIPESTATUS[*]}" == "0 0"

# What ends the orthogonal walk changes the tests, not the answers. Parallels turned against each
# other.
awk 'BEGIN { print 56, 2, 0, 0; for (i = 0; i < 56; i++) print i, i % 8 * 45 + int(i / 8) * 17, int(i / 8) * 30 - 90 }' >turned.node
awk 'BEGIN { print 96, 3, 0
    for (i = 0; i < 48; i++) {
        a = i; b = i % 8 == 7 ? i - 7 : i + 1;
        print 2*i, a, b, b+8; print 2*i+1, a, b+8, a+8 } }' >turned.ele
head -n 30000 many.csv >some.csv
final_tests() { # final_tests NAME: those per query of the final location that --finish NAME makes
    run star --lonlat --walk orthogonal --finish "$1" --stats --json turned.node some.csv -o \
        finish.csv
    exits 0
    holds "auto and --finish $1 agree" same_text auto.csv finish.csv
    tests=$(sed -nE 's/.*"orient_final": ([0-9.]+).*/\1/p' "$logs/err")
}
run star --lonlat turned.node some.csv -o auto.csv; exits 0
final_tests auto; automatic=$tests
final_tests stochastic; stochastic=$tests
final_tests forgetful; forgetful=$tests
holds "auto makes $automatic tests, stochastic $stochastic" test "$automatic" == "$stochastic"
holds "forgetful makes $forgetful tests, stochastic $stochastic" \
    awk "BEGIN { exit !($forgetful > 1.01 * $stochastic) }"

# --open: what is in the facets that are left is as on the whole; the others are outside.
printf '%s\n' "$octahedron" | sed -e '2s/ 8 / 6 /' -e '$d' | sed '$d' >open.off
run star --lonlat octahedron.off many.csv -o whole.csv; exits 0
run star --lonlat --open open.off many.csv -o open.csv --stats; exits 0
holds 'open facets are outside' awk -F, '
    NR == FNR { row[FNR] = $0; triangle[FNR] = $4; next }
    FNR > 1 && triangle[FNR] < 6 && $0 != row[FNR] { wrong++ }
    FNR > 1 && triangle[FNR] >= 6 && ($3 != "outside" || $4 != -1 || $5 != "") { wrong++ }
    FNR > 1 { kept += triangle[FNR] < 6; open += triangle[FNR] >= 6 }
    END { exit !(wrong == 0 && kept > 1000 && open > 1000) }' whole.csv open.csv
says '^outside +[1-9]'
run_on $'0 0 0\n1 nan 0\n' star --open open.off -; exits 0; prints_line '^0,0,0,bad,-1,,,$'
run star --lonlat open.off many.csv; refused 3 'edge . has no neighbour: the polyhedron is not closed'
says 'with --open'
for option in '--walk barycentric' '--start grid' '--borrow'; do
    run star --open $option open.off many.csv; refused 2 'cannot be used with --open, which finds facets'
done
run star --open --centre 0,0,0.1 open.off many.csv; refused 2 'leave out --centre'
printf '%s\n' OFF '3 0 0' '0 0 1' '1 0 1' '0 1 1' >empty.off
run_on $'1 2 3\n' star --open empty.off -; refused 3 'empty\.off: the surface has no triangle'
holds "--open has no check to offer" test -z "$(grep 'check --as star' "$logs/err")"
run star --open --remesh 2 open.off -o none.off; refused 2 "'--open' is for DIRECTIONS"
run sample --open --field z open.off many.csv; refused 2 "option '--open' needs --as star"
run sample --as star --lonlat --field z --status octahedron.off many.csv -o whole.csv; exits 0
run sample --as star --lonlat --open --field z --status open.off many.csv -o open.csv; exits 0
holds 'values are the same' awk -F, '
    NR == FNR { row[FNR] = $0; next }
    $4 != "outside" && $0 != row[FNR] { wrong++ }
    $4 == "outside" && $3 != "" { wrong++ }
    $4 == "outside" { open++ }
    END { exit !(wrong == 0 && open > 1000) }' whole.csv open.csv

# Real polyhedra, where they are at hand: every walk and start agrees, nothing is lost.
data=${MW_SHARED:-}/star
[[ -d $data ]] || { left_out "there is no ../shared/data"; finish; }
head -n 3000 many.csv >some.csv
for file in eros_7790.obj.gz psyche.obj kw4_alpha.obj.gz sphere_1620.off geosphere.off \
    ellipsoid.off sphere_1280.obj \
    brain_sphere_left.off.gz; do
    run star --lonlat --strict "$data/$file" some.csv -o auto.csv; exits 0; says_nothing
    for walk in $walks; do
        run star --lonlat --walk "$walk" "$data/$file" some.csv -o walk.csv; exits 0
        holds "$file: auto and $walk agree" same_text auto.csv walk.csv
    done
    for start in $starts; do
        run star --lonlat --start "$start" --threads 2 "$data/$file" some.csv -o start.csv; exits 0
        holds "$file: auto and --start $start agree" same_text auto.csv start.csv
    done
done
run star --lonlat "$data/brain_pial_left.off.gz" some.csv; refused 3 'triangle [0-9]+: '
says 'check --as star --lonlat '
finish

#!/usr/bin/env bash
# Tables of queries: every column comes back as it stands, the answers stand behind it; which
# columns are coordinates.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
printf '%s\n' "$square" >square.off # on the plane z = x + y

# Ids, times, quoted text, quotes and line ends in it, empty cells, missing values.
cat >wells.csv <<'END'
site,date,Easting,Northing,remark,z
B12,2024-05-01T10:00,0.75,0.25,"dry, windy",NA
007,1.50,  0.25 , 0.75,,+1e3
B14,,NA,NA,"he said ""wet""",
"B
15",,0.5,0.5,5" pipe,-
END
run sample square.off wells.csv; exits 0; says_nothing
prints 'site,date,Easting,Northing,remark,z,z_mw
B12,2024-05-01T10:00,0.75,0.25,"dry, windy",NA,1
007,1.50,  0.25 , 0.75,,+1e3,1
B14,,NA,NA,"he said ""wet""",,
"B
15",,0.5,0.5,5" pipe,-,1'
run sample --status square.off wells.csv; exits 0
prints_line '^site,.*,z,z_mw,status$'; prints_line '^B12,.*,NA,1,inside$'
prints_line '^B14,.*,,,bad$'
prints_line '^15",,0.5,0.5,5" pipe,-,1,edge$'
run sample --only-answers --status square.off wells.csv; exits 0
prints $'x,y,z,status\n0.75,0.25,1,inside\n0.25,0.75,1,inside\nnan,nan,,bad\n0.5,0.5,1,edge'
run sample --strict square.off wells.csv; exits 1
run locate square.off wells.csv; exits 0; prints_line '^site,date,.*,z,status,triangle,w0,w1,w2$'
prints_line '^B14,,NA,NA,"he said ""wet""",,bad,-1,,,$'
gzip -k wells.csv
run sample square.off wells.csv -o plain.csv; exits 0
run sample square.off wells.csv.gz -o packed.csv; exits 0
holds "gzip makes no difference" same_text plain.csv packed.csv
sed 's/$/\r/' wells.csv | "$meshwalk" sample square.off - | sed 's/\r//' >crlf.csv
holds "CR LF makes no difference" same_text plain.csv crlf.csv

# All forms of a missing value; anything else that is no number is an error, in a column that is
# read.
{ echo id,x,y
for missing in '' - NA na N/A NaN nan NULL null '""' '"NA"' ' NA '; do
    echo "1,$missing,0.5"
done; } >missing.csv
run locate square.off missing.csv; exits 0
holds "each of them is bad" test "$(grep -c '^1,.*,0\.5,bad,-1,,,$' "$logs/out")" == 12
wrongs=(-- none 1.5m '#N/A' 0x10 '1 2' '"1" 2')
for wrong in "${wrongs[@]}"; do
    run_on "id;x;y"$'\n'"1;0;0"$'\n'"1;0.5;$wrong"$'\n' locate square.off -; exits 3
    says 'standard input:3: column 3: '
done
{ echo 'id;x;y;note'; for wrong in "${wrongs[@]}"; do echo "1;0;0;$wrong"; done; } >notes.csv
run locate square.off notes.csv; exits 0
holds "they may stand elsewhere" same_text notes.csv \
    <(sed -E '1s/;status.*//; 2,$s/;vertex;0;1;0;0$//' "$logs/out")

# Separators stay; decimal commas, too, and then the answers have them. Blanks become commas.
run_on $'id;x;y\n1;0,75;0,25\n2;0,5;0,25\n' sample square.off -; exits 0
prints $'id;x;y;z\n1;0,75;0,25;1\n2;0,5;0,25;0,75'
run_on $'id;x;y\n1;0.75;0.25\n2;0.5;0.25\n' sample square.off -; exits 0
prints $'id;x;y;z\n1;0.75;0.25;1\n2;0.5;0.25;0.75'
run_on $'id;x;y\n1;0,75;0,25\n' sample --only-answers square.off -; exits 0
prints $'x,y,z\n0.75,0.25,1'
run_on $'id\tx\ty\n\t\t\n1\t0,5\t0,25\n' sample --status square.off -; exits 0
prints $'id\tx\ty\tz\tstatus\n\t\t\t\tbad\n1\t0,5\t0,25\t0,75\tinside'
run_on $' id x   y "a note"\n\n1 0.5 0.25 "b c"\n 2\t0.25 0.5 a,b \n# no row\n3 NA - 5"\n' sample \
    square.off -
exits 0
prints $'id,x,y,"a note",z\n1,0.5,0.25,"b c",0.75\n2,0.25,0.5,"a,b",0.75\n3,NA,-,"5""",'

# The shortest row.
run_on $'x,y\n,\n0.75,0.25\n' sample --status square.off -; exits 0
prints $'x,y,z,status\n,,,bad\n0.75,0.25,1,inside'

# Names: letters of any case, other signs, units.
for pair in x,y X,Y lon,lat LONG,LAT lng,lat Longitude,Latitude decimalLongitude,decimalLatitude \
    Easting,Northing \
    eastings,northings east,north E,N POINT_X,POINT_Y 'Point X,Point Y' X_coord,Y_coord \
    xcoord,ycoord CoordX,CoordY \
    x_coordinate,y_coordinate utm_x,utm_y x_utm,y_utm 'UTM Easting,UTM Northing' \
    Rechtswert,Hochwert 'x (m),y [m]'; do
    run_on "id,$pair,h"$'\nB1,0.75,0.25,9\n' locate square.off -; exits 0
    prints "id,$pair,h,status,triangle,w0,w1,w2"$'\nB1,0.75,0.25,9,inside,0,0.25,0.5,0.25'
    name=${pair%,*} name=${name% (m)}
    holds "meshwalk.1 lists $name" grep -iqw "${name//[_ ]/}" \
        <(tr -d _ <"$source_tree/docs/man/meshwalk.1")
done
run_on $'Northing,k,EASTING\n0.25,9,0.75\n' locate square.off -; exits 0
prints_line '^0.25,9,0.75,inside,0,'
# Years as names of columns, a header that looks like numbers otherwise.
run_on $'id,x,y,2019,2020\n1,0.75,0.25,5,6\n' locate square.off -; exits 0
prints_line '^1,0.75,0.25,5,6,inside,0,'

# What is not clear is asked for, with the columns.
for table in 'id,a,b' 'lat,depth' 'lon,depth' 'x,z' 'id,x' 'depth,x'; do
    run_on "$table"$'\n' locate square.off - -o o.csv
    refused 2 "standard input: which of its [23] columns are x,y\? They are: ${table//,/, }; use --columns, with names"
done
run_on $'id,x,y,lon,lat\n1,0,0,5,6\n' locate square.off - -o o.csv
refused 2 'Both x,y and lon,lat fit\. They are: id, x, y, lon, lat;'
run_on $'id,x,y,X\n1,0,0,5\n' locate square.off - -o o.csv
refused 2 'Several are called X\. They are'
run_on $'1 0.5 0.5\n' locate square.off - -o o.csv
refused 2 'which of its 3 columns are x,y\? They have no names; use --columns'
run_on $'x\n1\n' locate square.off - -o o.csv
refused 3 'standard input: has 1 column, but a row is x,y'
run_on $'id,x,y,X\n1,0,0,5\n' locate square.off --columns x,y - -o o.csv
refused 3 "columns 2 and 4 are both called 'x': use a number"
run_on $'id,a,b\n1,0,0\n' locate square.off --columns a,c - -o o.csv
refused 3 "no column 'c' among the 3: id, a, b"
absent o.csv
run_on $'id,x,y,lon,lat\n1,0,0,5,6\n' locate square.off - --columns x,y; exits 0
prints_line '^1,0,0,5,6,vertex,0,'
run_on $'u,v\n0.75,0.25\n' locate square.off -; exits 0; prints_line '^u,v,status,'
prints_line '^0.75,0.25,inside,0,'

# Tables without names.
run_on $'0.75 0.25\n' locate square.off -; exits 0; prints_line '^x,y,status,'
run_on $'9 0.75 0.25 8\n' locate --columns 2,3 square.off -; exits 0
prints $'c1,x,y,c4,status,triangle,w0,w1,w2\n9,0.75,0.25,8,inside,0,0.25,0.5,0.25'
run_on $'0.25 8 0.75\n' locate --columns 3,1 square.off -; exits 0; prints_line '^y,c2,x,status,'
prints_line '^0.25,8,0.75,inside,0,'
printf '0.75 0.25 7\n' >p.xyz
run sample square.off p.xyz; exits 0; prints $'x,y,c3,z\n0.75,0.25,7,1'
run_on '' sample square.off -; exits 0; prints x,y,z
run_on $'id,x,y\n' sample square.off -; exits 0; prints id,x,y,z
run_on $'id,name,lat\n' sample square.off -; refused 2 'which of its 3 columns'

# Names that are taken; names that are no single cell.
run_on $'Status,x,y,status_mw,w0\n1,0,0,2,3\n' locate square.off -; exits 0
prints_line '^Status,x,y,status_mw,w0,status_mw2,triangle,w0_mw,w1,w2$'
printf '4 2 1 0\n# attributes: x\n0 0 0 1\n1 1 0 1\n2 1 1 1\n3 0 1 1\n' >f.node
printf '2 3 0\n0 0 1 2\n1 0 2 3\n' >f.ele
run_on $'id,x,y\n1,0,0\n' sample --field attribute1 f.node -; exits 0
prints $'id,x,y,attribute1\n1,0,0,1'

# An id may begin with #; a comment does not have all the columns, or stands where a number is read.
run_on $'# made by hand\nid,x,y\n#12,0,0\n# no, row\n#13,1,0\n#\n14,1,1\n' sample square.off -
exits 0
prints $'id,x,y,z\n#12,0,0,0\n#13,1,0,1\n14,1,1,2'
run_on $'x,y,id\n#0,0,a\n1,0,b\n#0,0,c\n' sample square.off -; exits 0; prints $'x,y,id,z\n1,0,b,1'
run_on $'id x y\n# of three\na 1 0\n' sample square.off -; exits 0; prints $'id,x,y,z\na,1,0,1'

# Rows of another length, a quote that does not end: the line is named.
run_on $'id,x,y\n1,0,0\n2,0\n' locate square.off -; exits 3
says 'standard input:3: 2 columns where the header has 3'
run_on $'id,x,y\n1,0,0\n2,0,0,\n' locate square.off -; exits 3
says 'standard input:3: 4 columns where the header has 3'
run_on $'id,x,y\n1,0,0\n"2,0,0\n3,0,0\n' locate square.off -; exits 3
says 'standard input:3: a quoted cell begins in this row'
{ echo 'id;x;y'; yes '1;0;1' | head -n 262144; echo '2;0,5;0'; } >late.csv
run locate square.off late.csv -o o.csv; exits 3
says 'late\.csv: has its first decimal comma after 262144 rows'; absent o.csv

# Many rows, on one thread and on two: the table is what it was, with two columns more.
awk 'BEGIN { print "id,x,y,name"; for (i = 0; i < 270000; i++) printf "B%d,%.3f,%.3f,\"st, %d\"\n", i, i % 997 / 800, i % 991 / 800, i % 7 }' >many.csv
for threads in 1 2; do
    run sample --status --threads $threads square.off many.csv -o $threads.csv
    exits 0
done
holds "one thread and two print the same" same_text 1.csv 2.csv
holds "the columns are kept" same_text many.csv <(sed -E 's/,[^,]*,[^,]*$//' 1.csv)
# Long rows: a block ends early, and its memory is bounded.
awk 'BEGIN { s = sprintf("%3000s", ""); gsub(/ /, "abc ", s); print "x,y,text"; for (i = 0; i < 6000; i++) print "0.5,0.5," s i }' >long.csv
run sample square.off long.csv -o o.csv; exits 0
holds "long rows are kept" same_text <(sed '1s/$/,z/; 2,$s/$/,1/' long.csv) o.csv
rm -f o.csv

# A field whose name needs quotes in a header, as the answer's own and beside a column of that name.
printf '%s\n' ply 'format ascii 1.0' 'element vertex 3' 'property double x' 'property double y' \
    'property double a"b,c' 'property double d;e' 'property double e,f' 'element face 1' \
    'property list uchar int vertex_indices' end_header '0 0 1 5 8' '1 0 2 6 9' '0 1 3 7 10' \
    '3 0 1 2' \
    >odd.ply
run_on $'x,y\n0,0\n' sample odd.ply - --field 'a"b,c'; exits 0; prints $'x,y,"a""b,c"\n0,0,1'
run_on $'x,y,"E,f"\n1,0,8\n' sample odd.ply - --field 'e,f'; exits 0
prints $'x,y,"E,f","e,f_mw"\n1,0,8,9'
run_on $'x;y\n0;1\n' sample odd.ply - --field 'd;e'; exits 0; prints $'x;y;"d;e"\n0;1;7'
run_on $'x,y\n0,1\n' sample odd.ply - --field 'd;e'; exits 0; prints $'x,y,d;e\n0,1,7'
finish

#!/usr/bin/env bash
# contours: closed or from border to border, at integer heights with flats too; levels; formats.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
# As in cli_vectors.sh: the leak checker may crash over the threads of GDAL.
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"

cat >gap.off <<'END'
OFF
6 3 0
0 0 10
4 0 20
4 4 30
0 4 20
8 0 40
8 4 50
3 0 1 2
3 0 2 3
3 4 5 2
END
run contours gap.off --levels 40,15,20,15; exits 0; says_nothing
prints 'line,elevation,closed,x,y
0,15,0,0,2
0,15,0,1,1
0,15,0,2,0
1,20,0,0,4
1,20,0,2,2
1,20,0,4,0
2,40,0,6,4
2,40,0,8,0'
cp "$logs/out" expected
run contours --threads 1 gap.off --levels 15,20,40; exits 0; prints "$(<expected)"
run contours gap.off --interval 0.1 --base 0.05; exits 0
prints_line '^[0-9]+,10[.]35,0,'
prints_line '^[0-9]+,49[.]95,0,'
holds 'levels are short' test -z "$(cut -d, -f2 "$logs/out" | grep -E '.{10}')"
run contours gap.off --levels 100; exits 0; prints 'line,elevation,closed,x,y'
says 'no line of these levels crosses the mesh'
run contours -q gap.off --levels 10; exits 0; prints 'line,elevation,closed,x,y'

# A flat roof at the level: the line runs along it, on the lower side. A peak at the level: no line.
printf '%s\n' OFF '9 8 0' '0 0 0' '2 0 0' '4 0 0' '0 2 0' '2 2 3' '4 2 3' '0 4 0' '2 4 0' \
    '4 4 0' '3 0 1 4' '3 0 4 3' '3 1 2 5' '3 1 5 4' '3 3 4 7' '3 3 7 6' '3 4 5 8' '3 4 8 7' \
    >roof.off
run contours roof.off --levels 3; exits 0
prints 'line,elevation,closed,x,y
0,3,0,4,2
0,3,0,2,2
0,3,0,4,2'
run contours roof.off --levels 0; exits 0; prints 'line,elevation,closed,x,y'

# Any heights: integers of few values on a grid, with and without vertices that have none. The test
# counts the edges that each level crosses, where no vertex is at a level.
grid() { # grid N VALUES SEED MISSING
    awk -v n="$1" -v values="$2" -v seed="$3" -v missing="$4" 'BEGIN {
        srand(seed)
        print "OFF"; print (n + 1) ^ 2, 2 * n * n, 0
        for (y = 0; y <= n; y++) for (x = 0; x <= n; x++)
            print x, y, rand() < missing ? "nan" : int(values * rand())
        for (y = 0; y < n; y++) for (x = 0; x < n; x++) {
            a = y * (n + 1) + x; b = a + 1; c = b + n + 1; d = c - 1
            if (rand() < 0.5) { print 3, a, b, c; print 3, c, d, a }
            else { print 3, a, b, d; print 3, b, c, d }
        }
    }'
}
# Every line has two points or more, none twice in a row, and is closed or ends at the border.
sound() { # sound N MISSING
    awk -F, -v n="$1" -v missing="$2" '
        function border(p, xy) { split(p, xy, ";")
            return missing || xy[1] == 0 || xy[2] == 0 || xy[1] == n || xy[2] == n }
        function check() { if (line == "") return
            if (count < 2) print "line", line, "is a point"
            if (closed ? first != last : !border(first) || !border(last))
                print "line", line, "is open" }
        NR == 1 { next }
        $1 != line { check(); line = $1; closed = $3; first = $4 ";" $5; count = 0; last = "" }
        { p = $4 ";" $5; if (p == last) print "line", line, "rests at", p; last = p; count++ }
        END { check() }' "$logs/out"
}
crossings() { # the edges of grid.off that the levels 0.5, 1.5, ... cross
    awk 'NR == 2 { n = $1; m = $2 } NR > 2 && NR <= n + 2 { z[NR - 3] = $3 }
        NR > n + 2 { for (k = 2; k <= 4; k++) { a = $k; b = $(k == 4 ? 2 : k + 1)
            if (a > b) { c = a; a = b; b = c }
            if ((a, b) in seen) continue
            seen[a, b]; sum += z[a] > z[b] ? z[a] - z[b] : z[b] - z[a] } }
        END { print sum }' grid.off
}
for seed in 1 2 3 4 5; do
    for values in 2 3 9; do
        grid 14 $values $seed 0 >grid.off
        run contours grid.off --interval 1; exits 0
        holds "lines of values $values, seed $seed are sound" test -z "$(sound 14 0)"
        run contours grid.off --interval 1 --base 0.5; exits 0
        holds 'lines between the values are sound' test -z "$(sound 14 0)"
        points=$(awk -F, 'NR > 1 { n++; if ($3 && $1 != line) n--; line = $1 } END { print n }' \
            "$logs/out")
        holds 'each crossed edge has one point' test "$points" == "$(crossings)"
        cut -d, -f4,5 "$logs/out" >points.csv; cut -d, -f2 "$logs/out" >levels
        run sample grid.off points.csv; exits 0
        holds 'points have their level' test -z "$(cut -d, -f3 "$logs/out" | paste -d, - levels |
            awk -F, 'NR > 1 && ($1 - $2 > 1e-12 || $2 - $1 > 1e-12)')"
        # Higher ground lies to the left: of closed lines, the sum of the areas of a level says
        # whether hills or pits are more; a step to the left of the first segment is higher.
        run contours grid.off --levels 0.5
        awk -F, 'NR > 1 { if ($1 == line) { dx = $4 - x; dy = $5 - y
            print (x + $4) / 2 - dy / 1000 "," (y + $5) / 2 + dx / 1000 }
            line = $1; x = $4; y = $5 }' OFMT=%.15g CONVFMT=%.15g "$logs/out" >left.csv
        run_on "$(echo x,y; cat left.csv)"$'\n' sample grid.off -; exits 0
        holds 'higher ground lies to the left' test -z \
            "$(awk -F, 'NR > 1 && $3 != "" && $3 <= 0.5' "$logs/out" | head -n 1)"
        grid 14 $values $seed 0.05 >grid.off
        run contours grid.off --interval 1; exits 0
        holds 'lines beside missing values are sound' test -z "$(sound 14 1)"
    done
done

# Vector files.
if "$meshwalk" --version | grep -q 'GDAL .*found'; then
    grid 14 9 1 0 >grid.off
    run contours grid.off --interval 2 -o expected.csv; exits 0
    lines=$(tail -n 1 expected.csv | cut -d, -f1)
    for ending in gpkg shp fgb geojson; do
        run contours -q grid.off --interval 2 -o lines.$ending; exits 0; says_nothing
        # What was written is read again: the profile along a contour is level.
        run profile -q gap.off lines.$ending; exits 0
        holds "lines.$ending has as many lines" test "$(tail -n 1 "$logs/out" | cut -d, -f1)" -ge \
            "$lines"
    done
else
    left_out 'GDAL is not found'
fi

# Polygons: bands of values, which share the lines of their levels.
run contours gap.off --levels 15,20,40 --polygons; exits 0; says_nothing
prints 'polygon,min,max,ring,x,y
0,10,15,0,0,0
0,10,15,0,2,0
0,10,15,0,1,1
0,10,15,0,0,2
0,10,15,0,0,0
1,15,20,0,2,0
1,15,20,0,4,0
1,15,20,0,2,2
1,15,20,0,0,4
1,15,20,0,0,2
1,15,20,0,1,1
1,15,20,0,2,0
2,20,40,0,4,0
2,20,40,0,4,4
2,20,40,0,0,4
2,20,40,0,2,2
2,20,40,0,4,0
3,20,40,0,6,4
3,20,40,0,4,4
3,20,40,0,8,0
3,20,40,0,6,4
4,40,50,0,8,0
4,40,50,0,8,4
4,40,50,0,6,4
4,40,50,0,8,0'
# A flat roof lies in the band above its level, and is a hole of the one below it.
run contours roof.off --levels 3 --polygons; exits 0
holds 'the roof has no area' test "$(cut -d, -f1,4 "$logs/out" | sort -u | wc -l)" == 2
run contours -q gap.off --levels 100 --polygons; exits 0
holds 'two parts in it' test "$(tail -n 1 "$logs/out" | cut -d, -f1-3)" == 1,10,100
printf '%s\n' OFF '4 2 0' '0 0 1' '4 0 2' '2 4 3' '2 2 4' '3 0 1 2' '3 0 1 3' >overlap.off
run contours overlap.off --interval 1 --polygons; refused 3 'overlap'
printf '%s\n' OFF '5 4 0' '0 0 1' '4 0 2' '4 4 3' '0 4 2' '2 0 1' '3 0 4 3' '3 4 1 2' '3 4 2 3' \
    '3 0 1 4' >flat.off
run contours flat.off --interval 1 --polygons; exits 0
says '1 triangles without area are left out'
prints_line '^0,1,2,0,4,0$'
# Between two others it is left out too: the one at its long edge is split. A vertex off the line of
# heights there makes no difference to what is covered.
for z in 10 5 -3; do
    printf '%s\n' OFF '5 4 0' '0 0 0' '4 0 7' '2 3 0' "2 0 $z" '2 -3 0' '3 0 1 2' '3 0 1 3' \
        '3 0 4 3' '3 3 4 1' >wall$z.off
done

# GEOS finds all of them valid, and their areas are those of the mesh, whatever meets where: many
# vertices at a level, a hair off it, missing, in large coordinates.
parts() { # triangles of FILE with three values
    awk 'NR == 2 { n = $1 } NR > 2 && NR <= n + 2 { z[NR - 3] = $3 }
        NR > n + 2 { m += z[$2] != "nan" && z[$3] != "nan" && z[$4] != "nan" } END { print m }' "$1"
}
valid() { # valid FILE AREA ARGUMENTS...
    local file=$1 area=$2
    run contours -q "$file" --polygons -o bands.geojson "${@:3}"; exits 0
    holds "polygons of $file ${*:3} are valid" \
        same_text <(python3 "$here/polygon_check.py" bands.geojson | grep -v ^area) \
        <(echo "sum $area")
}
if ! "$meshwalk" --version | grep -q 'GDAL .*found'; then
    left_out 'GDAL is not found: no polygons are checked'
elif ! python3 "$here/polygon_check.py" <(echo '{"features": []}') >"$logs/geos"; then
    left_out 'GEOS is not found: no polygons are checked'
else
    for seed in 1 2; do
        for values in 2 9; do
            for missing in 0 0.05; do
                grid 14 $values $seed $missing >grid.off
                area=$(parts grid.off | awk '{ printf "%.9g", $1 / 2 }')
                valid grid.off "$area" --interval 1
                valid grid.off "$area" --interval 0.37
            done
        done
    done
    for z in 10 5 -3; do valid wall$z.off 12 --interval 2.5; done
    perl -e 'srand 3; print "x,y,z\n500000,4200000,1\n500900,4200000,1\n500900,4200900,1\n",
        "500000,4200900,1\n"; for (1 .. 2000) { my $z = int rand 8;
        $z += (rand() - 0.5) * 1e-12 if rand() < 0.5;
        printf "%.3f,%.3f,%.17g\n", 500000 + rand 900, 4200000 + rand 900, $z }' >near.csv
    run triangulate -q near.csv -o near.ply; exits 0
    valid near.ply 810000 --interval 1
    valid near.ply 810000 --interval 0.5
    for ending in gpkg shp fgb; do
        run contours -q near.ply --polygons --interval 2 -o bands.$ending; exits 0; says_nothing
        run locate -q near.csv --polygons bands.$ending
        exits 0
    done
fi

# Only triangles that a level crosses are looked at, but for what is never right.
printf '%s\n' OFF '7 5 0' '0 0 0' '4 0 0' '0 4 9' '4 4 9' '-4 2 0' '9 9 20' '-9 -9 30' '3 0 1 2' \
    '3 1 3 2' '3 4 0 2' '3 0 2 5' '3 0 6 1' >fan.off
run contours fan.off --levels 5; refused 3 'triangle 3: two others share its edge 0, from vertex 2'
run contours fan.off --levels 25; exits 0
prints 'line,elevation,closed,x,y
0,25,0,-6.833333333333334,-7.5
0,25,0,-7.5,-7.5'
sed 's/^9 9 20$/9 nan 20/' fan.off >nan.off
run contours nan.off --levels 25; refused 3 'vertex 5'
sed 's/^3 0 2 5$/3 0 2 2/' fan.off >twice.off
run contours twice.off --levels 25; refused 3 'twice'

# Heights that no level can be made for, and those that are missing everywhere.
printf '%s\n' OFF '3 1 0' '0 0 nan' '4 0 nan' '0 4 nan' '3 0 1 2' >missing.off
printf '%s\n' OFF '0 0 0' >none.off
for file in missing none; do
    run contours $file.off --interval 1; exits 0; prints 'line,elevation,closed,x,y'
    says 'no line of these levels crosses the mesh'
done
run contours missing.off --interval 1 --polygons; exits 0; says 'no triangle has a value'
sed 's/nan/5/' missing.off >level.off
run contours level.off --interval 5; exits 0; says 'no line of these levels crosses the mesh'
sed 's/0 4 nan/0 4 inf/; s/nan/5/' missing.off >infinite.off
run contours infinite.off --interval 1; refused 4 'more than 1000000 levels between 5 and inf'
for wrong in 1e-320 5e-324 1e-300; do
    run contours gap.off --interval $wrong; refused 4 "--interval $wrong makes more than 1000000"
done
run contours gap.off --interval 1 --base 1e300
refused 4 "--interval 1 is too small for values between 10 and 50, counted from 1e300"
run contours -q gap.off --interval 1e300; exits 0; prints 'line,elevation,closed,x,y'

# What is refused.
run contours gap.off; refused 2 'which levels\?'
run contours gap.off --interval 1 --levels 2; refused 2 'not both'
run contours gap.off --levels 1,x; refused 2 "'--levels' must be numbers"
run contours gap.off --levels ''; refused 2 ''
for wrong in 0 -1 nan x 1x; do
    run contours gap.off --interval $wrong; refused 2 "'--interval' must be a positive number"
done
run contours gap.off --levels 1 --base 2; refused 2 "'--base' needs --interval"
run contours gap.off --interval 1e-9; refused 4 'more than 1000000 levels'
run contours gap.off --levels 1 --field depth; refused 3 "has no field 'depth'"
run contours absent.off --levels 1; refused 3 'absent.off'
# More rows than are written at a time.
if [[ -w /dev/full ]]; then
    run contours gap.off --interval 0.001 -o /dev/full; exits 4; says 'No space left on device'
fi
run contours gap.off --levels 1 -o gap.off; refused 2 'gap.off'
finish

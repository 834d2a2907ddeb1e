#!/usr/bin/env bash
# bench: each table has its rows, published numbers and ratios; wrong usage is refused; plots are
# written.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
header=$'table\tdataset\tvertices\talgorithm\tquantity\tours\tpublished\tratio'
few=(--queries 100 --no-times --format tsv)

# Every line has its columns, numbers where there should be some, and the ratio is that of the
# numbers.
sound() { # sound LINES
    holds "the first line names the columns" test "$(head -n 1 "$logs/out")" == "$header"
    holds "there are $1 lines, not $(($(wc -l <"$logs/out") - 1))" test "$(wc -l <"$logs/out")" == \
        $(($1 + 1))
    local wrong
    wrong=$(tail -n +2 "$logs/out" | awk -F '\t' '
        function number(s) { return s ~ /^[0-9]+(\.[0-9]+)?$/ }
        NF != 8 || !number($3) || !number($6) || ($7 != "" && !number($7)) { print; next }
        ($7 == "" || $7 == 0) && $8 != "" { print; next }
        $7 > 0 && ($8 - $6 / $7 > 0.001 || $6 / $7 - $8 > 0.001) { print }')
    holds "wrong lines: $wrong" test -z "$wrong"
}
publishes() { # publishes SET VERTICES ALGORITHM QUANTITY VALUE
    checks=$((checks + 1))
    grep -Pq "^[A-G][123]\t$1\t$2\t$3\t$4\t[^\t]+\t$5\t" "$logs/out" ||
        fail "$1 $2 $3 $4: $5 should be published"
}
ours() { # ours SET VERTICES ALGORITHM QUANTITY: what was measured
    awk -F '\t' -v OFS='\t' -v key="$1 $2 $3 $4" '$2 " " $3 " " $4 " " $5 == key { print $6 }' \
        "$logs/out"
}
# shellcheck disable=SC2317 # called by holds
between() { awk -v a="$1" -v b="$2" -v c="$3" 'BEGIN { exit !(a <= b && b <= c) }'; }

# Ten quantities a walk and set without times, twelve with them.
run bench paper E2 --sizes 1e4 "${few[@]}"; exits 0; says_nothing; sound 70
publishes uniform 10000 straight triangles_init 2.8
publishes uniform 10000 straight triangles 105.5
publishes uniform 10000 straight orient 210
publishes uniform 10000 barycentric orient 309.6
publishes uniform 10000 normal-straight implicit 213.2
publishes uniform 10000 orthogonal comparisons 410.8
publishes uniform 10000 orthogonal orient 3.5
publishes uniform 10000 improved-orthogonal triangles_final 1.8
run bench paper E2 --sizes 1e4 --queries 10 --format tsv; exits 0; sound 84
publishes uniform 10000 stochastic time_us 7.4
publishes uniform 10000 normal-straight time_exact_us 5.82

run bench paper A1 --sizes 1e5 "${few[@]}"; exits 0; says_nothing; sound 200
publishes uniform 100000 remembering triangles 377.8
publishes uniform 100000 remembering implicit 0
publishes uniform 100000 normal-straight orient_final 3.77
publishes clusters 100000 straight orient 346.68
run bench paper A2 --sizes 1e5 "${few[@]}"; exits 0; sound 50
publishes uniform 100000 normal-straight triangles_final_max 10
publishes clusters 100000 normal-straight triangles_final 3.23
run bench paper B1 --sizes 1e4,1e5 "${few[@]}"; exits 0; sound 100
publishes uniform 100000 hybrid comparisons 685.23
publishes uniform 10000 stochastic triangles 115.19
run bench paper b2 --sizes 1e4 "${few[@]}"; exits 0; sound 30
publishes rectangle 10000 improved-orthogonal triangles_final 17.45
publishes rectangle 10000 improved-orthogonal-vertex triangles_final 17.45
publishes rectangle 10000 hybrid triangles 123.07
# Sets in the place of the thesis' own data, as large as they are: walks are about as long as
# published.
run bench paper C1 --sizes 4897,34932 --queries 2000 --no-times --format tsv; exits 0; says_nothing
sound 280
publishes cadastre 4897 straight triangles 88.2
publishes lidar 34932 remembering triangles 205.5
for walk in remembering stochastic barycentric straight direct-dw1; do
    holds "$walk in parcels" between 75 "$(ours cadastre 4897 "$walk" triangles)" 110
    holds "$walk in flight strips" between 160 "$(ours lidar 34932 "$walk" triangles)" 260
done
run bench paper C1 --sizes 4897 --queries 100 --no-times; exits 0; says_nothing
prints_line "^cadastre, 4897 vertices; a made set in the place of the thesis' own$"
run bench paper C1 --sizes 1e4 "${few[@]}"; exits 0; sound 70
publishes uniform 10000 direct-dw1 orient 104.2
publishes uniform 10000 direct-dw2 orient 207.4
run bench paper C2 --sizes 100,1000,10000 "${few[@]}"; exits 0; sound 180
publishes uniform 100 direct-dw2 orient 13.5
publishes uniform 10000 improved-orthogonal comparisons 43.1
publishes uniform 10000 remembering layers 3
for n in 100 1000 10000; do
    layers=$(ours uniform $n direct-dw1 layers)
    holds "C2 has the layers of the table" test "$layers" == $((n < 10000 ? 2 : 3))
done

# The straight walk among uniform points, by the theory 64 / (3 pi^2) sqrt(n) 0.5214: 112.7
# triangles.
run bench paper C1 --sizes 1e4 --queries 20000 --no-times --format tsv; exits 0
walked=$(ours uniform 10000 straight triangles)
holds "the straight walk takes about 112.7 triangles, not $walked" between 109 "$walked" 116
holds "stored areas save a test a triangle" \
    between 0.9 "$(ours uniform 10000 direct-dw1 triangles)" \
    "$(ours uniform 10000 direct-dw1 orient)"

# Counts depend on the seed alone.
run bench paper B1 --sizes 1e4 "${few[@]}" --threads 1; cp "$logs/out" one.tsv
run bench paper B1 --sizes 1e4 "${few[@]}" --threads 2
holds "the number of threads changes nothing" same_text one.tsv "$logs/out"
run bench paper B1 --sizes 1e4 "${few[@]}" --seed 7
holds "another seed changes something" test "$(<one.tsv)" != "$(<"$logs/out")"
rm one.tsv

# Several seeds: the mean of the runs, and their standard deviation, here of two: half of the
# difference times root two.
of_seeds() { awk -F '\t' '$4 == "hybrid" && $5 == "triangles" { print $6, $9 }' "$logs/out"; }
for seed in 3 4; do
    run bench paper B2 --sizes 1e3 "${few[@]}" --seed $seed
    exits 0
    of_seeds
done >two.txt
run bench paper B2 --sizes 1e3 "${few[@]}" --seed 3 --seeds 2; exits 0
holds "there is a column more" test "$(head -n 1 "$logs/out" | cut -f 9)" == spread
holds "it is the mean, and the spread" awk -v of="$(of_seeds)" '{ x[NR] = $1 } END {
    split(of, f, " "); d = (x[1] - x[2]) / sqrt(2); if (d < 0) d = -d;
    e = (x[1] + x[2]) / 2 - f[1]; d -= f[2]
    exit !(d * d < 1e-6 && e * e < 1e-6 && f[2] > 0) }' two.txt
run bench paper B2 --sizes 1e3 --queries 100 --no-times --seeds 2; exits 0
prints_line '^ +algorithm .* spread +published'
run bench paper B2 --seeds 1001; refused 2 "'--seeds' must be at most 1000"
run bench peers --seeds 2; refused 2 "seeds and --walk are for 'bench paper'"
rm two.txt

# Other sizes and enclosures: nothing published for these sizes; four corners, or none.
run bench paper B1 --sizes 500 "${few[@]}"; exits 0; sound 50
holds "nothing is published for 500 vertices" test -z \
    "$(tail -n +2 "$logs/out" | cut -f 7 | tr -d '\n')"
for enclose in yes no; do
    run bench paper B2 --sizes 50,60 --enclose $enclose "${few[@]}"
    exits 0
    sound 60
done
run bench paper A1 --sizes 10,11 "${few[@]}"; exits 0; sound 400

# One's own data: points and meshes; named after the file; nothing published. Equal points count
# once, four corners more.
printf '0 0\n4 0\n4 3\n0 3\n1 1\n1 1\n3 2\n2 1\n' >p.xyz
printf '%s\n' "$square" >m.off
run bench paper E2 --data p.xyz,./m.off "${few[@]}"; exits 0; says_nothing; sound 140
holds "nothing is published for them" test -z "$(tail -n +2 "$logs/out" | cut -f 7 | tr -d '\n')"
holds "both are named" test "$(tail -n +2 "$logs/out" | cut -f 2,3 | sort -u | tr '\n' ' ')" == \
    $'m.off\t4 p.xyz\t7 '
run bench paper C2 --data p.xyz "${few[@]}"; exits 0; sound 60
run bench paper A1 --data "$source_tree/data/jacksboro.csv" --queries 50 --no-times; exits 0
prints_line '^jacksboro.csv, 20000 vertices$'
prints_line '^  stochastic +RSW  triangles +1\.[0-9]{3}  1\.092 to 1\.092$'
run bench paper A1 --data absent.xyz "${few[@]}"; refused 3 'absent.xyz'
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n' >broken.off
run bench paper A1 --data broken.off "${few[@]}"; refused 3 'broken.off.*after 2 of 3 vertices'
printf '0 0\n1 0 oops\n0 1\n' >broken.xyz
run bench paper A1 --data broken.xyz "${few[@]}"; refused 3 'broken.xyz:2: '
run bench paper A1 --data . "${few[@]}"; refused 3 '\.: Is a directory'
rm broken.off broken.xyz
printf '0 0\n1 1\n2 2\n' >line.xyz
run bench paper A1 --data line.xyz "${few[@]}"; refused 3 'line.xyz'
: >empty.xyz
for enclose in yes no; do
    run bench paper A1 --data empty.xyz --enclose $enclose "${few[@]}"
    refused 3 'empty.xyz'
done
printf '0 0\n1 1\n2 nan\n0 1\n' >nan.xyz
run bench paper E2 --data nan.xyz "${few[@]}"; refused 3 'nan.xyz.*2'

# Appendix D: of each domain its mesh, and four rows: queries in it or in its hull, from a random
# triangle or a sample. Eighteen quantities a walk without times. The border walk and the filled
# mesh are compared by the program.
run bench paper D1 --sizes 4897,500 "${few[@]}"; exits 0; says_nothing; sound 440
publishes cadastre 4897 mesh mesh_triangles 9635
publishes cadastre 4897 mesh hull_percent 75.53
publishes cadastre-mesh-random 4897 border walk_runs 1.08
publishes cadastre-hull-random 4897 border triangles_border 142.2
publishes cadastre-mesh-sample 4897 border sample 17
publishes cadastre-hull-sample 4897 border triangles_total 158.9
holds "the mesh has as many triangles as the table's" test \
    "$(ours cadastre 4897 mesh mesh_triangles)" == 9635
holds "and border edges" test "$(ours cadastre 4897 mesh mesh_border_edges)" == 163
holds "and fills as much of its hull" between 74 "$(ours cadastre 4897 mesh hull_percent)" 77
holds "few lines leave the mesh" between 0 "$(ours cadastre-mesh-random 4897 border border_runs)" \
    0.5
holds "a hundred queries in the mesh" test \
    "$(ours cadastre-mesh-random 4897 border inside_percent)" == 100
holds "fewer of those in the hull" between 55 \
    "$(ours cadastre-hull-random 4897 border inside_percent)" 95
holds "the border walk builds less" test "$(ours cadastre-mesh-random 4897 border locator_bytes)" \
    -lt \
    "$(ours cadastre-mesh-random 4897 straight-filled locator_bytes)"
holds "a filled mesh has no border to go round" test \
    "$(ours cadastre-hull-random 500 auto-filled border_runs)" == 0
holds "the border walk goes round some" \
    between 0.1 "$(ours cadastre-hull-random 500 border border_runs)" \
    "$(ours cadastre-hull-random 500 border border_edges)"
walked=$(ours cadastre-hull-sample 4897 border triangles) \
    round=$(ours cadastre-hull-sample 4897 border triangles_border)
total=$(awk "BEGIN { print $walked + $round + 16 }")
holds "all triangles are those of both phases and of the sample, $total" \
    test "$(ours cadastre-hull-sample 4897 border triangles_total)" == "$total"
run bench paper D1 --sizes 10,11,30,100 --seed 5 "${few[@]}"; exits 0; says_nothing; sound 880
run bench paper D1 --sizes 300 "${few[@]}" --threads 1; cp "$logs/out" one.tsv
run bench paper D1 --sizes 300 "${few[@]}" --threads 2
holds "the number of threads changes nothing" same_text one.tsv "$logs/out"
# A ring of eight triangles round a hole; the hull is a square of 16, the hole one of 4.
ring='OFF
8 8 0
0 0 0
4 0 0
4 4 0
0 4 0
1 1 0
3 1 0
3 3 0
1 3 0
3 0 1 5
3 0 5 4
3 1 2 6
3 1 6 5
3 2 3 7
3 2 7 6
3 3 0 4
3 3 4 7'
printf '%s\n' "$ring" >ring.off
run bench paper D1 --data ring.off --queries 4000 --no-times --format tsv; exits 0; says_nothing
sound 220
holds "a hole" test "$(ours ring.off 8 mesh mesh_holes)" == 1
holds "the mesh fills three quarters of its hull" test "$(ours ring.off 8 mesh hull_percent)" == 75
holds "so many queries are inside" between 72 \
    "$(ours ring.off-hull-random 8 border inside_percent)" 78
run bench paper D1 --data ring.off --queries 100; exits 0; says_nothing
prints_line '^  mesh +mesh_border_edges +8$'
prints_line '^  border +border_runs +[0-9.]+$'
prints_line '^  over those of straight-filled$'
run bench paper D1 --data p.xyz "${few[@]}"; refused 3 'p.xyz: this is not a mesh'
run bench paper D1 --data ring.off --enclose yes "${few[@]}"; refused 2 'meshes, which --enclose'
printf 'OFF\n3 1 0\n0 0 0\n1 1 0\n2 2 0\n3 0 1 2\n' >flat.off
run bench paper D1 --data flat.off "${few[@]}"; refused 3 'flat.off'
rm one.tsv

# Appendix F: rays from the centre. Seven quantities a walk without times, and the triangles of the
# mesh. A number of vertices of a subdivided tetrahedron, octahedron or icosahedron makes it,
# another one a random star. All walks are compared by the program.
run bench paper F1 --sizes 42,500,34,66 "${few[@]}"; exits 0; says_nothing; sound 144
holds "an icosahedron" test "$(ours icosahedron 42 mesh mesh_triangles)" == 80
holds "a tetrahedron" test "$(ours tetrahedron 34 mesh mesh_triangles)" == 64
holds "an octahedron" test "$(ours octahedron 66 mesh mesh_triangles)" == 128
holds "a star" test "$(ours star 500 mesh mesh_triangles)" == 996
holds "the barycentric walk makes three tests a triangle" test \
    "$(ours star 500 barycentric orient)" == \
    "$(awk -v n="$(ours star 500 barycentric triangles)" 'BEGIN { print 3 * n }')"
holds "to remember the entry edge saves tests" test "$(tail -n +2 "$logs/out" | awk -F '\t' '
    $2 == "star" && $3 == 500 && $5 == "orient" { n[$4] = $6 }
    END { print (n["stochastic"] < n["forgetful"]) }')" == 1
run bench paper F1 --sizes 163842 --queries 4000 --no-times --format tsv; exits 0; says_nothing
sound 36
publishes icosahedron 163842 barycentric triangles 361.2
publishes icosahedron 163842 forgetful orient 680.7
publishes icosahedron 163842 orthogonal triangles_final 1.93
publishes icosahedron 163842 mesh mesh_triangles 327680
for figure in 'barycentric triangles 361.2' 'barycentric orient 1083.5' \
    'forgetful triangles 392.3' \
    'forgetful orient 680.7' 'orthogonal triangles 515.1' 'orthogonal comparisons 1030.2'; do
    read -r walk quantity value <<<"$figure"
    measured=$(ours icosahedron 163842 "$walk" "$quantity")
    holds "$walk, $quantity: $measured is within 3 percent of $value" \
        between 0.97 "$(awk "BEGIN { print $measured / $value }")" 1.03
done
measured=$(ours icosahedron 163842 orthogonal orient_final)
holds "tests of the final location: $measured is within 10 percent of 4.8" between 4.32 \
    "$measured" 5.28
run bench paper F2 --sizes 10242 --queries 4000 --no-times --format tsv; exits 0; says_nothing
sound 75
for figure in '128 6.2' '512 8.0' '2048 9.7'; do
    read -r elements value <<<"$figure"
    measured=$(ours icosahedron-"$elements" 10242 octahedron triangles_init)
    holds "down an octahedron of $elements facets: $measured is within 4 percent of $value" \
        between 0.96 "$(awk "BEGIN { print $measured / $value }")" 1.04
done
holds "more cells, shorter walks" between 1 "$(ours icosahedron-2048 10242 grid triangles)" \
    "$(ours icosahedron-128 10242 grid triangles)"
run bench paper F2 --sizes 163842 --queries 10 --format tsv; exits 0; sound 93
publishes icosahedron-128 163842 octahedron triangles_init 6.2
publishes icosahedron-512 163842 grid time_exact_us 4.96
publishes icosahedron-2048 163842 nonuniform-grid comparisons 16.5
run bench paper F1 --sizes 300 "${few[@]}" --threads 1; cp "$logs/out" one.tsv
run bench paper F1 --sizes 300 "${few[@]}" --threads 2
holds "the number of threads changes nothing" same_text one.tsv "$logs/out"
rm one.tsv
# Polyhedra of one's own: about the origin, or else about the mean of the vertices.
for at in 0 100; do
    awk -v a=$at 'BEGIN { print "OFF\n4 4 0"; print a + 1, 1, 1; print a + 1, -1, -1; print a - 1, 1, -1; print a - 1, -1, 1
        print "3 0 1 2\n3 0 3 1\n3 0 2 3\n3 1 3 2" }' >tetrahedron.off
    run bench paper F1 --data tetrahedron.off --queries 100; exits 0; says_nothing
    prints_line '^tetrahedron.off, 4 vertices$'
    prints_line '^  barycentric +WBW  exact time +[0-9.]+  0\.772 to 0\.786$'
done
# A file that stands in for a model of the thesis, said or by its name and its triangles.
run bench paper F1 --data skull=tetrahedron.off,tetrahedron.off "${few[@]}"; exits 0; says_nothing
publishes tetrahedron.off 4 forgetful triangles 135.2
holds "published once" test "$(grep -c 135.2 "$logs/out")" == 1
run bench paper F2 --data bunny=tetrahedron.off "${few[@]}"; exits 0; says_nothing
publishes tetrahedron.off-128 4 octahedron triangles_init 6.2
run bench paper F1 --data blob=tetrahedron.off "${few[@]}"; refused 2 "unknown model 'blob'"
run bench paper G1 --data blbo=tetrahedron.off "${few[@]}"; refused 2 "did you mean 'blob'"
run bench paper F1 --data skull= "${few[@]}"; refused 2 "model 'skull'"
run bench paper F1 --data ring.off "${few[@]}"; refused 3 'ring.off'
run bench paper F1 --data p.xyz "${few[@]}"; refused 3 'p.xyz: this is not a mesh'
run bench paper F1 --sizes 42 --enclose yes "${few[@]}"; refused 2 'meshes, which --enclose'

# Appendix G: probes of a surface. Nine quantities without times, and the triangles of the mesh.
# What is found is compared with a complete search by the program.
for table in G1 G2 G3; do
    run bench paper $table --sizes 154,600 "${few[@]}"; exits 0; says_nothing; sound 40
    holds "the hull of n points has 2n - 4 triangles" test "$(ours bumps 154 mesh mesh_triangles)" \
        == 304
    holds "two times the whole cube root of the vertices" test "$(ours bumps 600 plane sample)" == \
        16
    case $table in
        G1) least=1000000 most=1000000 ;;
        G2) least=900000 most=1000000 ;;
        G3) least=0 most=0 ;;
    esac
    holds "so many are found" between "$least" "$(ours bumps 600 plane found_per_million)" "$most"
done
holds "all iterations are made in vain" test "$(ours bumps 600 plane iterations)" == 10
run bench paper G2 --sizes 154 "${few[@]}" --threads 1; cp "$logs/out" one.tsv
run bench paper G2 --sizes 154 "${few[@]}" --threads 2
holds "the number of threads changes nothing" same_text one.tsv "$logs/out"
rm one.tsv
# A file with the name of a model and about as many triangles stands beside the published numbers;
# another does not.
awk 'BEGIN { print "OFF\n152 304 0"; p = 3.14159265358979
    for (i = 0; i < 19; i++) for (k = 0; k < 8; k++) {
        r = 3 + cos(k * p / 4);
        print r * cos(i * 2 * p / 19), r * sin(i * 2 * p / 19), sin(k * p / 4) }
    for (i = 0; i < 19; i++) for (k = 0; k < 8; k++) {
        a = i * 8 + k; b = i * 8 + (k + 1) % 8;
        c = (i + 1) % 19 * 8 + (k + 1) % 8; d = (i + 1) % 19 * 8 + k
        print 3, a, d, c; print 3, a, c, b } }' >pawn-like.off
cp pawn-like.off ring19.off
run bench paper G1 --data pawn-like.off,ring19.off "${few[@]}"; exits 0; says_nothing; sound 20
publishes pawn-like.off 152 mesh mesh_triangles 304
publishes pawn-like.off 152 plane iterations_max 14
holds "nothing is published for the other" test -z \
    "$(grep ring19 "$logs/out" | cut -f 7 | tr -d '\n')"
run bench paper G1 --data pawn-like.off --queries 100; exits 0; says_nothing
prints_line "^pawn-like.off, 152 vertices; published: the thesis' pawn$"
prints_line '^  plane +time_exact_us +[0-9.]+ +2\.30 +[0-9.]+$'
run bench paper G1 --data p.xyz "${few[@]}"; refused 3 'p.xyz: this is not a mesh'
run bench paper G1 --data flat.off "${few[@]}"; refused 3 'flat.off: the surface has no area'
run bench paper G3 --sizes 154 --enclose yes "${few[@]}"; refused 2 'meshes, which --enclose'
rm flat.off tetrahedron.off pawn-like.off ring19.off

# Appendix E: four triangulations of the same points.
run bench paper E1 --sizes 1000 "${few[@]}"; exits 0; says_nothing; sound 25
for kind in greedy min-weight; do
    holds "$kind has shorter edges than delaunay" \
        between 1 "$(ours uniform 1000 $kind edge_length)" \
        "$(ours uniform 1000 delaunay edge_length)"
done
holds "none is shorter than min-weight" \
    between 1 "$(ours uniform 1000 min-weight edge_length)" \
    "$(ours uniform 1000 greedy edge_length)"
# The corners of the square are vertices: its sides are the only edges that count once.
edges=$(ours uniform 1000 delaunay edge_length) sides=$(ours uniform 1000 delaunay side_length)
holds "inner edges count twice: $edges, $sides" \
    between -0.001 "$(awk "BEGIN { print 2 * $edges - 4 - $sides }")" 0.001
run bench paper E1 --walk straight --sizes 1000 "${few[@]}"; exits 0; sound 25
holds "the walk is named" test "$(cut -f 2 "$logs/out" | sort -u | tr '\n' ' ')" == \
    'dataset uniform-straight '
run bench paper E1 --walk all --sizes 100 "${few[@]}"; exits 0
holds "there is a set for each walk" test "$(cut -f 2 "$logs/out" | sort -u | wc -l)" == 17
run bench paper C1 --walk straight; refused 2 'walk is for E1, not C1'
run bench paper E1 --walk strait; refused 2 "unknown walk 'strait'; did you mean 'straight'\?"
run bench paper E1 --sizes 1e4 --queries 10 --no-times --format tsv; exits 0; sound 25
publishes uniform 10000 delaunay side_length 723.09
publishes uniform 10000 min-max-angle triangles 120.187
publishes uniform 10000 kinds correlation 0.998
holds "the edges are as long as published" \
    between 716 "$(ours uniform 10000 delaunay side_length)" 730
printf '0 0\n3 0\n3 3\n0 3\n1 1\n' >five.xyz
run bench paper E1 --data five.xyz --enclose no --queries 100; exits 0; says_nothing
prints_line '^  min-weight +MWT +optimal +1$'
rm five.xyz

# A strip along the diagonal: queries are drawn until enough are in it, however few that are of
# those drawn; but there is an end. Points so far apart that their extent overflows.
strip() { awk -v w="$1" \
    'BEGIN { for (i = 0; i <= 200; i++) print i / 200, i / 200 + (i % 2 ? w : 0) }'; }
strip .002 >strip.xyz
run bench paper A2 --data strip.xyz --queries 3000 --no-times --format tsv; exits 0; says_nothing
sound 10
strip .00001 >strip.xyz
run bench paper A2 --data strip.xyz "${few[@]}"
refused 3 'strip.xyz: the mesh fills less than a thousandth'
printf -- '-1e308 -1e308\n1e308 1e308\n-1e308 1e308\n1e308 -1e308\n' >far.xyz
for enclose in yes no; do
    run bench paper A2 --data far.xyz --enclose $enclose "${few[@]}"
    refused 3 'far.xyz: the extent .* too large'
done
printf '0 0\n1 1\n2 inf\n0 1\n' >far.xyz
run bench paper E2 --data far.xyz "${few[@]}"; refused 3 'far.xyz.*2'
rm strip.xyz far.xyz

# The other formats.
run bench paper B2 --sizes 1e4 --queries 50; exits 0; says_nothing
prints_line '^rectangle, 10000 vertices$'
prints_line '^  hybrid +HW +comparisons +[0-9.]+ +245\.46 +[01]\.[0-9]{3}$'
prints_line '^  improved-orthogonal        IOW  triangles +1\.[0-9]+ +1\.279 +[01]\.[0-9]{3}$'
run bench paper B2 --sizes 1e4 --queries 50 --format json -o b2.json; exits 0; prints ''
holds "the figures are JSON" is_json b2.json
holds "JSON has 36 figures" test "$(grep -c '"quantity"' b2.json)" == 36
rm b2.json

# Wrong usage, found before any work.
run bench; refused 2 'expected WHAT \[TABLE\], found 0 arguments'
run bench paper; refused 2 'which table\? A1, .*E2'
run bench paper E3; refused 2 "unknown table 'E3'; did you mean 'E1'\?"
run bench papre E2; refused 2 "unknown measurement 'papre'; did you mean 'paper'\?"
run bench paper E2 E2; refused 2 'expected WHAT \[TABLE\], found 3 arguments'
for sizes in '' ',' 9 '1e4,' 1.5e4 1e99 x -5 ' 100' 600000000 20,20,20,20,20,20,20,20,20; do
    run bench paper E2 --sizes="$sizes"; refused 2 "'--sizes'"
done
run bench paper E2 --enclose maybe; refused 2 "unknown way to enclose 'maybe'"
run bench paper E2 --format csv; refused 2 "unknown format 'csv'"
run bench paper E2 --data p.xyz,; refused 2 "'--data' must be files"
run bench paper E2 --data p.xyz -o p.xyz; refused 2 'choose another output'
run bench paper E2 -o absent/e2.tsv; exits 4; says 'absent/e2.tsv'

# Plots, where the program can draw.
run bench paper B2 --plot b2.gif
if grep -q 'without Cairo' "$logs/err"; then
    refused 2 'without Cairo'
else
    refused 2 'b2.gif: .*\.svg, \.png or \.pdf'
    run bench paper E2 --plot e2.svg --no-times; refused 2 'shows times'
    ln -s . here
    for other in x.svg ./x.svg "$PWD/x.svg" here/x.svg; do
        run bench paper A2 --plot x.svg -o "$other" "${few[@]}" --sizes 10
        refused 2 'x.svg: .*must go to different files'
        absent x.svg
    done
    : >there.svg
    ln -s there.svg link.txt
    run bench paper A2 --plot there.svg -o link.txt "${few[@]}" --sizes 10
    refused 2 'there.svg: .*must go to different files'
    mkdir sub
    run bench paper A2 --plot x.svg -o sub/x.svg "${few[@]}" --sizes 10; exits 0; says_nothing
    holds "one is a plot, the other a table" grep -q '^table' sub/x.svg
    rm -r here there.svg link.txt sub x.svg
    run bench paper E2 --plot absent/x.svg --sizes 1e4; exits 4; says 'absent/x.svg'
    run bench paper E2 --plot e2.svg --sizes 1e4,2e4 --queries 20 -q; exits 0; says_nothing
    holds "the plot is an SVG" grep -q '<svg' e2.svg
    run bench paper A2 --plot a2.PNG --sizes 100 "${few[@]}"; exits 0
    holds "the plot is a PNG" test "$(head -c 4 a2.PNG | tr -d '\211')" == PNG
    run bench paper B2 --plot b2.pdf --data p.xyz,m.off "${few[@]}"; exits 0
    holds "the plot is a PDF" test "$(head -c 4 b2.pdf)" == %PDF
    run bench paper D1 --plot d1.svg --sizes 100,200 "${few[@]}"; exits 0; says_nothing
    holds "the plot has the panels of Fig. 11 and 12" test "$(grep -c '<svg' d1.svg)" == 1
    run bench paper D1 --plot d1.svg --data ring.off "${few[@]}"; exits 0; says_nothing
    run bench paper E1 --plot e1.svg --sizes 50,60 "${few[@]}"; exits 0; says_nothing
    for table in F1 F2 G3; do
        run bench paper $table --plot $table.svg --sizes 42,500 "${few[@]}"; exits 0; says_nothing
        holds "the plot of $table is an SVG" grep -q '<svg' $table.svg
        rm $table.svg
    done
    rm e2.svg a2.PNG b2.pdf d1.svg e1.svg
    # Where the clock stands still all times are 0, which a logarithmic axis has no place for beside
    # the published ones. (Under a sanitizer no other clock can be loaded.)
    printf '#include <time.h>\nint clock_gettime(clockid_t c, struct timespec *t) { t->tv_sec = t->tv_nsec = c * 0; return 0; }' |
        cc -x c -shared -fPIC -o clock.so - 2>/dev/null
    if [[ -e clock.so ]] && LD_PRELOAD="$PWD/clock.so" "$meshwalk" --version >/dev/null 2>&1; then
        LD_PRELOAD="$PWD/clock.so" run bench paper E2 --plot still.svg --sizes 20,1e4 --queries 20 \
            -q
        exits 0; says_nothing
        holds "the plot is an SVG" grep -q '<svg' still.svg
    fi
    rm -f clock.so still.svg
fi

# Near vertices: 14 walks in two arithmetics; in exact arithmetic none of them is ever caught.
run bench near-vertices --sizes 1000 --queries 2000 --format tsv -o near.tsv; exits 0; says_nothing
holds "five sets of 34 rows" test \
    "$(tail -n +2 near.tsv | cut -f 1 | uniq -c | awk '$1 == 34' | wc -l)" == 5
holds "each row has nine cells" test "$(awk -F '\t' 'NF != 9' near.tsv | wc -l)" == 0
holds "in exact arithmetic no cycle, no hand-over" \
    test "$(awk -F '\t' '$4 == "exact" && ($6 != 0 || $7 != 0)' near.tsv | wc -l)" == 0
holds "in doubles there are some" test \
    "$(awk -F '\t' '$4 == "double" { n += $7 } END { print (n > 0) }' near.tsv)" == 1
run bench near-vertices rings --sizes 1000,2000 --queries 100 --format tsv -o near.tsv; exits 0
holds "one set, two sizes" test "$(cut -f 1,2 near.tsv | sort -u | wc -l)" == 3
run bench near-vertices uniform --sizes 1000 --queries 100; exits 0
prints_line '^  celestial +exact +0 +0$'
run bench near-vertices ring; refused 2 "unknown set 'ring'; did you mean 'rings'\?"
run bench near-vertices --sizes x; refused 2 "'--sizes'"
run bench near-vertices --data p.xyz; refused 2 'makes its own points'
run bench near-vertices --no-times; refused 2 'leave out --no-times'
run bench near-vertices --sizes 1e8 -o absent/near.tsv; exits 4; says 'absent/near.tsv'
rm near.tsv
only_files p.xyz m.off ring.off line.xyz empty.xyz nan.xyz
finish

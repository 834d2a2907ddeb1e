#!/usr/bin/env bash
# convert: meshes from one format to another, what is lost on the way, exit codes.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"

printf 'a mesh\n2 5\n%s\n' '1 0 0 0.5
2 2 0 1
3 2 2 -1
4 0 2 0.001
5 4 0 7
1 4 1 2 3 4
2 3 2 5 3
1
2
2
1
2
1
2
2 24
5
3' >a.gr3

# There and back again.
run convert -q a.gr3 b.gr3; exits 0
head -13 a.gr3 | tail -11 >wanted
holds "vertices, faces and boundaries are the same" diff wanted <(tail -n +3 b.gr3 | head -11 |
    sed 's/ = .*//')
for to in vtu 2dm; do
    run convert -q a.gr3 "b.$to"; exits 0
    run convert -q "b.$to" c.gr3; exits 0
    holds "$to keeps vertices, their depth, and faces" diff <(head -7 wanted) \
        <(tail -n +3 c.gr3 | head -7)
done
run convert a.gr3 b.vtu; exits 0
says 'has no place for marked edges: open 1, land 1 type 24 are not written; fort.14, gr3 and msh'
run info b.vtu; exits 0 # XML, but nothing for GDAL
prints_line '^vertices +5$'
(echo '<?xml version="1.0"?>' && printf '<!-- %300s -->\n' x && tail -n +2 b.vtu) >long.vtu
run info long.vtu
exits 0
prints_line '^vertices +5$'
run convert a.gr3 b.14; exits 0
says "barriers are not written, as their heights are not known: 'land 1 type 24'"
holds "ADCIRC has triangles only" test "$(sed -n 2p b.14)" = '3 5'
run convert -q a.gr3 -o b.off; exits 0; says_nothing
run convert a.gr3 b.off; exits 0
says 'the format off has no place for fields: depth is not written; ply, node and vtu have one'
run convert a.gr3 b.2dm; exits 0
holds "2dm has heights, which are depths turned round" grep -q '^ND 5 4 0 -7$' b.2dm
holds "and quadrilaterals" grep -q '^E4Q 1 1 2 3 4 1$' b.2dm
run convert b.2dm b.msh; exits 0; says_nothing
holds "materials are physical groups" grep -q '^1 3 2 1 1 1 2 3 4$' b.msh
run convert a.gr3 c.msh
says_nothing
run convert c.msh c.gr3
exits 0
holds "msh keeps depths and faces" diff <(head -7 wanted) <(tail -n +3 c.gr3 | head -7)
# Heights and a depth, where a format has one place for a number at a vertex.
printf '%s\n' ply 'format ascii 1.0' 'element vertex 3' 'property double x' 'property double y' \
    'property double z' 'property double depth' 'element face 1' \
    'property list uchar int vertex_indices' end_header '0 0 5 7' '1 0 5 8' '0 1 5 9' '3 0 1 2' \
    >deep.ply
for to in gr3 14; do
    run convert deep.ply deep.$to; exits 0
    says 'has a place for heights or for the depth: the depth is written, the heights are not$'
    holds "the depth is in deep.$to" grep -q '^2 1 0 8$' deep.$to
done
run convert deep.ply deep.2dm; exits 0
says 'deep.2dm: warning: the format 2dm has no place for fields: depth is not written'
holds "that is all" test "$(wc -l <"$logs/err")" == 1
holds "the heights are in deep.2dm" grep -q '^ND 2 1 0 5$' deep.2dm
run_on 'MESH2D
ND 1 0 0 0
ND 2 1 0 0
ND 3 0 1 0
E3T 1 1 2 3 -1.25' convert --format msh - d.msh
exits 0
says 'the format msh has no place for these values of triangles: material is not written'
run_on "$(cat b.msh)" convert --format fort.14 - -; exits 0
says 'the format fort.14 has no place for these values of triangles: physical is not written'
prints_line '^5 4 0 7$'

# The coordinate system stays: inside PLY, else in a file beside.
cp a.gr3 hgrid.ll
run convert -q hgrid.ll b.ply; exits 0
holds "PLY holds the system" grep -qa 'comment crs EPSG:4326' b.ply
run convert --crs EPSG:32610 -q b.2dm d.msh; exits 0
holds "a system on request" grep -q 'EPSG:32610\|UTM zone 10N\|UTM_zone_10N\|UTM Zone 10' d.prj

# What cannot be done leaves nothing behind.
run convert a.gr3; exits 2
run convert a.gr3 x.nothing; exits 2; says 'no mesh format has this ending'
run convert a.gr3 -; exits 2; says 'needs --format'
run convert a.gr3 a.gr3; exits 2; says 'is both input and output'
run convert -o x.off a.gr3 y.off; exits 2; says "two outputs, 'y.off' and -o x.off"
run convert none.gr3 x.off; exits 3; says 'none.gr3'
printf 'bad\n1 3\n' >bad.gr3
run convert bad.gr3 x.off; exits 3; says 'bad.gr3:2: the file ends after 0 of 3 vertices'
run convert a.gr3 nowhere/x.off; exits 4
holds "nothing is left" test ! -e x.off -a ! -e y.off -a ! -e x.nothing

# Boundaries that are barriers, by the types of fort.14; what stands last is the last one named.
marked() { # marked NAME NAME: a square with two marked edges
    printf '%s\n' '$MeshFormat' '2.2 0 8' '$EndMeshFormat' '$PhysicalNames' 2 "1 1 \"$1\"" \
        "1 2 \"$2\"" '$EndPhysicalNames' '$Nodes' 4 '1 0 0 0' '2 1 0 0' '3 1 1 0' '4 0 1 0' \
        '$EndNodes' '$Elements' 4 '1 1 2 1 1 1 2' '2 1 2 2 2 3 4' '3 2 2 0 1 1 2 3' \
        '4 2 2 0 1 1 3 4' '$EndElements' >marked.msh
}
for type in 0 1 2 3 4 5 6 12 13 15 22 23 25 26 29 30 33 35; do
    marked "land type $type" wall
    run convert marked.msh -o marked.14; exits 0
    case $type in
    3 | 4 | 5 | 13 | 15 | 23 | 25)
        says "^meshwalk: marked.14: warning: barriers are not written, .*: 'land type $type' and perhaps others$"
        ;;
    *) says_nothing ;;
    esac
done
marked wall 'land type 4'
run convert marked.msh -o marked.14; says "barriers are not written, .*: 'land type 4'$"
marked 'open type 4' wall
run convert marked.msh -o marked.14; says_nothing
run convert marked.msh -o marked.off
says "marked.off: warning: the format off has no place for marked edges: open type 4, wall are not written"

# Eight names of fields that are lost, and a number for more.
for count in 1 2 8 9 11; do
    echo "3 2 $count 0" >fields.node
    for corner in '0 0 0' '1 1 0' '2 0 1'; do
        echo "$corner$(printf ' %d' $(seq $count))" >>fields.node
    done
    printf '%s\n' '1 3 0' '0 0 1 2' >fields.ele
    run convert fields.node -o fields.off; exits 0
    names=$(printf 'attribute%d, ' $(seq $((count < 8 ? count : 8))))
    names=${names%, }
    ((count > 8)) && names+=" and $((count - 8)) more"
    says "^meshwalk: fields.off: warning: the format off has no place for fields: $names $(
        ((count > 1)) && echo are || echo is) not written; ply, node and vtu have one$"
done

# Whole numbers of 32 bits are kept as the groups of msh, others are not.
for value in 2147483647 -2147483647 2147483648 1.5; do
    printf '%s\n' '# vtk DataFile Version 3.0' x ASCII 'DATASET UNSTRUCTURED_GRID' \
        'POINTS 3 double' '0 0 0 1 0 0 0 1 0' 'CELLS 1 4' '3 0 1 2' 'CELL_TYPES 1' 5 'CELL_DATA 1' \
        'SCALARS physical double 1' 'LOOKUP_TABLE default' "$value" >group.vtk
    run convert group.vtk -o group.msh; exits 0
    case $value in
    *7) says_nothing ;;
    *) says 'group.msh: warning: the format msh has no place for .*: physical is not written' ;;
    esac
done

# Where no mesh is written.
run convert marked.msh -o x.mwm; refused 2 "'meshwalk prepare MESH -o x.mwm' writes prepared meshes"
run convert marked.msh -o x.off.gz; refused 2 'x.off.gz: gzip is read, but not written'
run convert marked.msh -o x.off.gz --format off; refused 2 'x.off.gz: gzip is read, but not written'
run convert marked.msh -o .gz --format off; exits 0
finish

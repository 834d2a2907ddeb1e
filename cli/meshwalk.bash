# Bash completion for meshwalk. Completes commands, options, names that options take, and files.

# Options of a command; all commands share the last ones.
_meshwalk_options() {
    local query='--walk --start --arithmetic --finish --fill --steps --areas --sample --cells --layers --descent --tolerance'
    query="$query --columns --crs --points-crs"
    query="$query --any --trust"
    local stream='--strict --stats --json --layer --where --only-answers'
    local common='-o --output --threads --seed --layout -q --quiet -h --help'
    case $1 in
        info) echo "--layer --as --centre --lonlat --weld --json $common" ;;
        check) echo "--fix --tolerance --numbers --format --as --centre --lonlat --weld --json $common" ;;
        triangulate) echo "--constraints --boundary --keep --split --strict --max-edge --from --tolerance --band --kind --weight --hidden --limit --format --columns --class --layer --where --crs --points-crs --constraints-crs --json $common" ;;
        locate) echo "--details --base --polygons --attribute --polygon-layer $query $stream $common" ;;
        sample) echo "--field --outside --missing --nodata --status --as --centre --lonlat --open --time --values --time-column --wide --recover $query $stream $common" ;;
        weights) echo "$query --method --values --norm --lonlat --open --strict --stats --json --layer --where $common" ;;
        apply) echo "--field --missing --strict --stats --json $common" ;;
        contours) echo "--interval --levels --base --polygons --field --nodata --crs $common" ;;
        drape) echo "--field --nodata --outside-z --attribute --layer --columns --crs --lines-crs --strict $common" ;;
        volume) echo "--base --against --field --against-field --nodata --crs --against-crs --json --strict $common" ;;
        profile) echo "--field --nodata --attribute --layer --columns --crs --lines-crs --strict $common" ;;
        raster)
            echo "--resolution --like --extent --field --time --values --mean --derive --nodata --outside --max-edge --vertex-nodata --type"
            echo "--driver --creation --crs --json $common"
            ;;
        visible)
            echo "--from --height --target-height --to --between --raster --resolution --like --extent --driver --creation --field"
            echo "--nodata --columns --crs --points-crs $stream $common"
            ;;
        edit)
            echo "--as --answers --heights --changes --numbers --log --constraints --undo --delaunay --skip --strict --walk"
            echo "--start --cells --layers --descent --format --stats --json $common"
            ;;
        star)
            echo "--centre --lonlat --open --remesh --onto --deviation --format --nodata --walk --start --finish --sample --cells --levels --borrow --columns $stream $common"
            ;;
        probe)
            echo "--max-distance --certain --extent --faces --min-distance --inside --all --one-per-place --nearest --start --guide --samples --iterations --race --weld --any --columns $stream $common"
            ;;
        walk) echo "--from --to --walk --animate --plane --grid --cells --max-distance --samples --iterations --as --centre --lonlat --weld $common" ;;
        convert) echo "--format --crs $common" ;;
        prepare) echo "--border --tiles --fields --crs $common" ;;
        view) echo "--points --columns --as --centre --lonlat --weld $common" ;;
        bench) echo "--queries --sizes --enclose --data --engines --tasks --rounds --ranks --walk --seeds --no-times --format --plot $common" ;;
    esac
}

# Names that an option of a command takes.
_meshwalk_names() {
    case $2 in
        --format)
            if [[ $1 == bench ]]; then
                echo 'table tsv json'
            else
                echo 'auto off ply ply-ascii node obj stl netcdf csv vtk vtu fort.14 gr3 2dm msh'
            fi
            ;;
        --layout) echo 'ugrid schism fvcom adcirc anuga fesom icon mpas tuflowfv' ;;
        --enclose) echo 'auto yes no' ;;
        --tasks) echo 'random sorted coherent half-outside total dense delaunay connectivity' ;;
        --engines)
            echo 'meshwalk meshwalk-single meshwalk-grid meshwalk-grid-single meshwalk-two-level'
            echo 'meshwalk-two-level-single meshwalk-curve meshwalk-curve-single meshwalk-last'
            echo 'meshwalk-borrowed meshwalk-borrowed-single'
            echo 'cgal cgal-hierarchy cgal-walk cgal-jump cgal-sorted cgal-last'
            echo 'embree-single embree-packets embree-sorted embree-coherent geos boost scipy matplotlib'
            ;;
        --help | -h) echo all ;;
        --fix) echo 'weld orient drop split all' ;;
        --grid) echo 'none uniform nonuniform' ;;
        --as)
            case $1 in
                sample) echo 'plane star' ;;
                edit) echo 'plane surface' ;;
                *) echo 'plane surface star' ;;
            esac
            ;;
        --walk)
            [[ $1 == star ]] && echo 'auto stochastic forgetful barycentric orthogonal straight' &&
                return
            echo 'auto lawson remembering stochastic forgetful fast-stochastic barycentric direct straight'
            echo 'normal-straight normal-straight-turn orthogonal improved-orthogonal improved-orthogonal-vertex'
            echo 'hybrid celestial border'
            [[ $1 == @(walk|bench) ]] && echo all
            ;;
        --start)
            case $1 in
                star) echo 'auto random sample front last sorted grid nonuniform-grid octahedron' ;;
                probe) echo 'auto last sample random' ;;
                *) echo 'auto random sample centre last sorted grid buckets triangle-buckets two-level-grid layers kd-tree curve chains' ;;
            esac
            ;;
        --arithmetic) echo 'exact double' ;;
        --finish)
            [[ $1 == star ]] && echo 'auto stochastic forgetful' && return
            echo 'auto remembering stochastic'
            ;;
        --fill) echo 'auto yes no' ;;
        --descent) echo 'auto nearest coordinate' ;;
        --sample) [[ $1 == star ]] || echo 'cube-root fourth-root' ;;
        --outside) [[ $1 == raster ]] && echo 'empty nearest' || echo 'empty nearest linear' ;;
        --type) echo 'auto float32 float64' ;;
        --derive) echo 'slope aspect hillshade triangle' ;;
        --missing)
            if [[ $1 == apply ]]; then echo 'empty leave-out'; else echo 'empty nearest'; fi
            ;;
        --nodata) echo none ;;
        --points-crs) echo same ;;
        --kind) echo 'delaunay greedy min-weight min-max-angle regular' ;;
        --keep) echo 'auto hull inside' ;;
        --delaunay) echo 'auto make never' ;;
        --class)
            echo 'never-classified unclassified ground low-vegetation medium-vegetation high-vegetation building'
            echo 'low-noise water rail road wire-guard conductor tower connector bridge-deck high-noise'
            ;;
    esac
}

# A list that 'info' tells of the first file in the line for which it is not empty, a name on each
# line.
_meshwalk_list() {
    local file
    for file in "${COMP_WORDS[@]:2}"; do
        file=${file/#\~\//$HOME/}
        [[ -f $file ]] || continue
        timeout 2 "${COMP_WORDS[0]}" info --json -- "$file" 2>/dev/null |
            sed -n "s/^ *\"$1\": \\[\"\(.*\)\"\\],*$/\\1/p" | sed 's/", "/\n/g' | grep . && return
    done
}

# Names of layers, of attributes, or of the values of a mesh.
_meshwalk_named() {
    local name
    while read -r name; do
        [[ $name == "$2"* ]] && COMPREPLY+=("$(printf %q "$name")")
    done < <(
        case $1 in
            --field)
                echo z
                _meshwalk_list fields
                ;;
            --attribute) _meshwalk_list fields ;;
            *) _meshwalk_list layers ;;
        esac
    )
}

_meshwalk() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
    local command=${COMP_WORDS[1]} names
    COMPREPLY=()
    # --walk=la comes as the three words --walk, = and la.
    if [[ $word == = ]]; then
        word=
    elif [[ $before == = && $COMP_CWORD -ge 2 ]]; then
        before=${COMP_WORDS[COMP_CWORD - 2]}
    fi
    if ((COMP_CWORD == 1)); then
        names='info check triangulate locate sample weights apply profile contours raster visible drape volume edit star probe walk convert prepare view bench --help --version'
        mapfile -t COMPREPLY < <(compgen -W "$names" -- "$word")
        return
    fi
    names=$(_meshwalk_names "$command" "$before")
    [[ $command == bench && $COMP_CWORD -eq 2 && $word != -* ]] &&
        names='paper near-vertices peers scale edit worst segments ocean terrain space'
    [[ $command == bench && $before == paper ]] && names='A1 A2 B1 B2 C1 C2 D1 E1 E2 F1 F2 G1 G2 G3'
    [[ $command == bench && $before == @(peers|scale) ]] &&
        names='uniform grid gaussian clusters arcs rectangle rings slivers offset cadastre lidar'
    [[ $command == bench && $before == edit ]] && names='uniform clusters gaussian arcs rectangle'
    if [[ -n $names ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$names" -- "$word")
        return
    fi
    case $before in
        --field | --attribute | --layer | --polygon-layer)
            _meshwalk_named "$before" "$word"
            return
            ;;
        --threads | --seed | --steps | --sample | --cells | --layers | --levels | --tolerance | \
            --columns | --resolution | --extent | --nodata | --vertex-nodata | --driver | \
            --creation | \
            --crs | --lines-crs | --constraints-crs | --where) return ;;
        --from | --to | --centre | --max-distance | --samples | --iterations | --race | \
            --max-edge | --queries | --sizes | --limit | --rounds | --seeds | --undo) return ;;
    esac
    if [[ $word == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$(_meshwalk_options "$command")" -- "$word")
        return
    fi
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
}

complete -F _meshwalk meshwalk

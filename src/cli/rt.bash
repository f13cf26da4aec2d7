# What rt's command line may go on with, for bash. Where this has no words, file names are offered.

_rt()
{
    local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} words done=
    COMPREPLY=()
    # "--size=64" is three words here.
    if [[ $current == = ]]; then
        current=
    elif [[ $before == = ]]; then
        before=${COMP_WORDS[COMP_CWORD - 2]}
    fi
    case $before in
    --accel) words="bvh none" ;;
    --accuracy) words="fast standard robust double" ;;
    --effects) words="scene all none" ;;
    --format) words="png bmp tga jpg hdr exr png16" ;;
    --lanes) words="1 4 8 16" ;;
    --progress) words="auto always never" ;;
    --device | -d)
        words="cpu gpu accelerator all scalar scalar-double
               $("${COMP_WORDS[0]}" --list-devices 2>/dev/null | awk '$1 ~ /^[0-9]+$/ { print $1 }')"
        done=,
        ;;
    --study-levels)
        words="fast standard robust double"
        done=,
        ;;
    --study-samples)
        words="1 4 16 64"
        done=,
        ;;
    --hits | --plot | --stats | --study) return ;;
    --error | --seconds | --size | --study-repeats | --tile)
        compopt +o default +o bashdefault
        return
        ;;
    *)
        [[ $current == -* ]] || return
        words="--accel= --accuracy= --cache --cache-clear --device= --effects= --error= --explain
               --format= --grammar --help --hits= --lanes= --list-devices --no-cost --plot= --prepare
               --progress= --quiet --seconds= --size= --stats= --study= --study-levels=
               --study-repeats= --study-samples= --tile= --verify --version"
        ;;
    esac
    # In a list only what follows the last comma is completed.
    [[ $done && $current == *,* ]] && done=${current%,*}, || done=
    COMPREPLY=($(compgen -P "$done" -W "$words" -- "${current#"$done"}"))
    [[ ${COMPREPLY[0]} == --*= ]] && compopt -o nospace
}

complete -o bashdefault -o default -F _rt rt

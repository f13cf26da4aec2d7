#compdef rt
# What rt's command line may go on with, for zsh.

_rt_devices()
{
    local -a devices
    devices=(cpu gpu accelerator all scalar scalar-double
        ${${(M)${(f)"$(_call_program devices $words[1] --list-devices 2>/dev/null)"}:#<->*}%% *})
    _values -s , device $devices
}

_arguments -s -S \
    '--accel=[how rays find primitives]:how:(bvh none)' \
    '--accuracy=[how accurate, whatever the scene says]:level:(fast standard robust double)' \
    '(- *)--cache[tell what is kept of built programs]' \
    '(- *)--cache-clear[remove what is kept of built programs]' \
    '(-d --device)'{-d+,--device=}'[where to render]:device:_rt_devices' \
    '--effects=[what is compiled into the kernels]:which:(scene all none)' \
    '--error=[add samples until the error is that small]:steps of 256: ' \
    '--explain[print what effects the scene calls for and what they cost]' \
    '--format=[what the picture is written as]:format:(png bmp tga jpg hdr exr png16)' \
    '(- *)--grammar[print the scene format as a table]' \
    '(- *)'{-h,--help}'[print a short help]' \
    '--hits=[write what each pixel hits]:file:_files' \
    '--lanes=[rays in a vector when tracing]:rays:(1 4 8 16)' \
    '(- *)--list-devices[list the OpenCL devices]' \
    '--no-cost[explain without measuring]' \
    '--plot=[make the report of a study anew]:figures:_files -g "*.json"' \
    '--prepare[compile what many scenes take]' \
    '--progress=[tell how far a long render is]:when:(auto always never)' \
    '(-q --quiet)'{-q,--quiet}'[print errors only]' \
    '--seconds=[add samples until so long has passed]:seconds: ' \
    '--size=[picture size in pixels]:WxH: ' \
    '--stats=[write what was done as JSON]:file:_files' \
    '--study=[measure what accuracy costs]:report:_files' \
    '--study-levels=[levels to study]:levels:_values -s , level fast standard robust double' \
    '--study-repeats=[timed repeats]:count: ' \
    '--study-samples=[samples a pixel to study]:counts:_values -s , count 1 4 16 64' \
    '--tile=[side of the tiles]:pixels: ' \
    '--verify[render with the scalar path too and compare]' \
    '(- *)--version[print the version]' \
    '1:scene:_files -g "*.txt"' \
    '2:picture:_files -g "*.(png|bmp|tga|jpg|jpeg|hdr|exr)"'

/* The command line as a user types it. */
#define _GNU_SOURCE
#include "support/support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"

#define MOST 16

static enum rt_code read_line(const char *line, rt_options *options, char *message, size_t size)
{
    static char words[512]; /* the options point into it */
    char *argv[MOST] = {(char[]){"rt"}};
    int argc = 1;
    rt_status status = RT_STATUS_INIT;
    snprintf(words, sizeof words, "%s", line);
    for (char *word = strtok(words, " "); word && argc < MOST - 1; word = strtok(NULL, " "))
        argv[argc++] = word;
    const bool good = rt_options_read(options, argc, argv, &status);
    assert_true(good == (status.code == RT_OK));
    snprintf(message, size, "%s", status.text ? status.text : "");
    const enum rt_code code = status.code;
    rt_status_clear(&status);
    return code;
}

static void good_lines(void **state)
{
    (void)state;
    char message[512];
    rt_options o;
    unsetenv("RT_DEVICE");
    assert_int_equal(read_line("s.txt o.png", &o, message, sizeof message), RT_OK);
    assert_string_equal(o.scene, "s.txt");
    assert_string_equal(o.output, "o.png");
    assert_string_equal(o.format->name, "png");
    assert_int_equal(o.target, RT_TARGET_DEVICE);
    assert_null(o.device);
    assert_int_equal(read_line("s.txt --size 640x480 o.hdr --device=1:0 --lanes 8 --tile 32 -q", &o,
                               message, sizeof message),
                     RT_OK);
    assert_int_equal(o.width, 640);
    assert_int_equal(o.height, 480);
    assert_string_equal(o.format->name, "hdr");
    assert_string_equal(o.device, "1:0");
    assert_int_equal(o.lanes, 8);
    assert_int_equal(o.tile, 32);
    assert_true(o.quiet);
    assert_int_equal(read_line("-d Scalar - -", &o, message, sizeof message), RT_OK);
    assert_int_equal(o.target, RT_TARGET_SCALAR);
    assert_int_equal(read_line("-d 0,gpu s.txt o.png", &o, message, sizeof message), RT_OK);
    assert_string_equal(o.device, "0,gpu");
    assert_int_equal(o.target, RT_TARGET_DEVICE);
    assert_int_equal(o.progress, RT_PROGRESS_AUTO);
    assert_int_equal(read_line("--progress always s.txt o.png", &o, message, sizeof message),
                     RT_OK);
    assert_int_equal(o.progress, RT_PROGRESS_ALWAYS);
    assert_int_equal(read_line("--progress=never s.txt o.png", &o, message, sizeof message), RT_OK);
    assert_int_equal(o.progress, RT_PROGRESS_NEVER);
    assert_int_equal(read_line("--progress always -q s.txt o.png", &o, message, sizeof message),
                     RT_OK);
    assert_int_equal(o.progress, RT_PROGRESS_NEVER);
    assert_int_equal(read_line("s.txt o.jpg --format png16", &o, message, sizeof message), RT_OK);
    assert_string_equal(o.format->name, "png16");
    assert_int_equal(read_line("--format exr s.txt -", &o, message, sizeof message), RT_OK);
    assert_string_equal(o.format->name, "exr");
    assert_int_equal(read_line("--verify s.txt", &o, message, sizeof message), RT_OK);
    assert_true(o.verify);
    assert_int_equal(read_line("--stats - s.txt", &o, message, sizeof message), RT_OK);
    assert_int_equal(read_line("--hits h s.txt", &o, message, sizeof message), RT_OK);
}

static void lines_of_a_study(void **state)
{
    (void)state;
    char message[512];
    rt_options o;
    assert_int_equal(read_line("--study r s.txt", &o, message, sizeof message), RT_OK);
    assert_string_equal(o.study, "r");
    assert_int_equal(o.action, RT_ACTION_STUDY);
    assert_true(o.plan.levels[RT_ACCURACY_FAST] && o.plan.levels[RT_ACCURACY_DOUBLE]);
    assert_int_equal(o.plan.sample_count, 4);
    assert_int_equal(o.plan.samples[3], 64);
    assert_int_equal(o.plan.repeats, 9);
    assert_int_equal(read_line("--study r --study-levels robust,fast --study-samples 16,1,16 "
                               "--study-repeats 3 s.txt",
                               &o, message, sizeof message),
                     RT_OK);
    assert_true(o.plan.levels[RT_ACCURACY_FAST] && o.plan.levels[RT_ACCURACY_ROBUST]);
    assert_false(o.plan.levels[RT_ACCURACY_STANDARD] || o.plan.levels[RT_ACCURACY_DOUBLE]);
    assert_int_equal(o.plan.sample_count, 2);
    assert_int_equal(o.plan.samples[0], 1);
    assert_int_equal(o.plan.samples[1], 16);
    assert_int_equal(o.plan.repeats, 3);
    assert_int_equal(read_line("--study r --device 0,cpu s.txt", &o, message, sizeof message),
                     RT_OK);
    assert_int_equal(read_line("--study r --device all s.txt", &o, message, sizeof message), RT_OK);
    assert_int_equal(read_line("-q --plot some/r.json", &o, message, sizeof message), RT_OK);
    assert_int_equal(o.action, RT_ACTION_PLOT);
    assert_string_equal(o.plot, "some/r.json");
}

static void lines_about_effects(void **state)
{
    (void)state;
    char message[512];
    rt_options o;
    assert_int_equal(read_line("s.txt o.png", &o, message, sizeof message), RT_OK);
    assert_int_equal(o.effects, RT_EFFECTS_SCENE);
    assert_false(o.explain || o.no_cost);
    assert_int_equal(read_line("--effects none s.txt o.png", &o, message, sizeof message), RT_OK);
    assert_int_equal(o.effects, RT_EFFECTS_NONE);
    assert_int_equal(read_line("--effects=all s.txt o.png", &o, message, sizeof message), RT_OK);
    assert_int_equal(o.effects, RT_EFFECTS_ALL);
    assert_int_equal(read_line("--explain s.txt", &o, message, sizeof message), RT_OK);
    assert_true(o.explain && !o.no_cost && !o.output);
    assert_int_equal(read_line("--explain --no-cost --device scalar --stats - s.txt", &o, message,
                               sizeof message),
                     RT_OK);
    assert_true(o.explain && o.no_cost);
    assert_int_equal(o.action, RT_ACTION_EXPLAIN);
}

static void lines_without_a_scene(void **state)
{
    (void)state;
    char message[512];
    rt_options o;
    assert_int_equal(read_line("--help", &o, message, sizeof message), RT_OK);
    assert_int_equal(o.action, RT_ACTION_HELP);
    assert_int_equal(read_line("--version", &o, message, sizeof message), RT_OK);
    assert_int_equal(o.action, RT_ACTION_VERSION);
    assert_int_equal(read_line("--list-devices", &o, message, sizeof message), RT_OK);
    assert_int_equal(o.action, RT_ACTION_LIST);
    assert_int_equal(read_line("--cache", &o, message, sizeof message), RT_OK);
    assert_int_equal(o.action, RT_ACTION_CACHE);
    assert_int_equal(read_line("--cache-clear", &o, message, sizeof message), RT_OK);
    assert_int_equal(o.action, RT_ACTION_CACHE_CLEAR);
    assert_int_equal(read_line("--prepare --accuracy double -d 0", &o, message, sizeof message),
                     RT_OK);
    assert_int_equal(o.action, RT_ACTION_PREPARE);
    assert_int_equal(o.accuracy, RT_ACCURACY_DOUBLE);
    assert_string_equal(o.device, "0");
}

static void the_environment_names_a_device(void **state)
{
    (void)state;
    char message[512];
    rt_options o;
    setenv("RT_DEVICE", "scalar-double", 1);
    assert_int_equal(read_line("s.txt o.png", &o, message, sizeof message), RT_OK);
    assert_int_equal(o.target, RT_TARGET_SCALAR_DOUBLE);
    assert_int_equal(read_line("--device cpu s.txt o.png", &o, message, sizeof message), RT_OK);
    assert_int_equal(o.target, RT_TARGET_DEVICE);
    assert_string_equal(o.device, "cpu");
    /* What is overridden need not make sense. */
    setenv("RT_DEVICE", "scalar,", 1);
    assert_int_equal(read_line("s.txt o.png", &o, message, sizeof message), RT_ERROR_USAGE);
    assert_int_equal(read_line("--device cpu s.txt o.png", &o, message, sizeof message), RT_OK);
    unsetenv("RT_DEVICE");
}

/* What is typed, and what comes back. */
static const char *const wrong_lines[][2] = {
    {"", "no scene is given"},
    {"s.txt", "no output is given"},
    {"s.txt o.gif", "'o.gif' does not end in .png"},
    {"s.txt png", "does not end in"},
    {"s.txt o.png --format gif", "--format takes png, bmp, tga, jpg, hdr, exr or png16"},
    {"--verify s.txt --format png", "--format is of the picture, and none is to be written"},
    {"s.txt o.png more", "one argument too many: more"},
    {"--frobnicate s.txt o.png", "cannot make sense of --frobnicate"},
    {"-x s.txt o.png", "cannot make sense of"},
    {"s.txt o.png --size", "a value is missing after --size"},
    {"s.txt o.png --size 640", "found '640'; --size takes WxH"},
    {"s.txt o.png --size 0x10", "--size takes"},
    {"s.txt o.png --size 10x-1", "--size takes"},
    {"s.txt o.png --size 10x10x", "--size takes"},
    {"s.txt o.png --size 70000x1", "--size takes"},
    {"s.txt o.png --size 65535x65535", "--size takes"},
    {"s.txt o.png --effects some", "found 'some'; --effects takes scene, all or none"},
    {"s.txt o.png --no-cost", "--no-cost is for --explain"},
    {"s.txt o.png --explain", "--explain renders no picture"},
    {"s.txt --explain --verify", "--explain renders no picture"},
    {"s.txt --explain --hits h", "--explain renders no picture"},
    {"s.txt --explain --effects all", "--explain is of the scene's own effects"},
    {"s.txt --explain --device scalar", "--explain measures an OpenCL device"},
    {"s.txt o.png --lanes 3", "found '3'; --lanes takes 1, 4, 8 or 16"},
    {"s.txt o.png --lanes x", "--lanes takes"},
    {"s.txt o.png --tile 0", "--tile takes a whole number from 1 to 4096"},
    {"s.txt o.png --tile 4097", "--tile takes"},
    {"s.txt - --stats -", "only one thing can go to standard output"},
    {"s.txt --verify --stats -", "only one thing"},
    {"s.txt --verify --device scalar", "--verify holds a device"},
    {"s.txt o.png --device=", "--device takes"},
    {"s.txt o.png --device 0,", "found '0,'; --device takes a name or index on each side"},
    {"s.txt o.png --device ,0", "--device takes"},
    {"s.txt o.png --device 0,,1", "--device takes"},
    {"s.txt o.png --device 0,Scalar", "the scalar path renders alone"},
    {"s.txt o.png --device scalar-double,0", "the scalar path renders alone"},
    {"s.txt o.png --device cpu,all", "all devices cannot be part of a list"},
    {"--study r s.txt o.png", "--study writes no picture, so there is no place for o.png"},
    {"--study= s.txt", "--study takes"},
    {"--study r --verify s.txt", "--study does not go with"},
    {"--study r --hits h s.txt", "--study does not go with"},
    {"--study r --stats - s.txt", "--study does not go with"},
    {"--study r --accuracy fast s.txt", "--study takes --study-levels"},
    {"--study r --device scalar s.txt", "--study holds a device"},
    {"--study r --device 0,,cpu s.txt", "--device takes"},
    {"--study r --device 0,scalar s.txt", "the scalar path renders alone"},
    {"--plot r.txt", "found 'r.txt'; --plot takes the REPORT.json of a study"},
    {"--plot .json", "--plot takes"},
    {"--plot r.json s.txt", "--plot reads what a study has found, and renders nothing"},
    {"--plot r.json --study r", "--plot reads what a study has found"},
    {"--prepare s.txt", "--prepare compiles what many scenes take, and renders none"},
    {"--prepare --stats -", "--prepare compiles what many scenes take, and renders none"},
    {"--prepare -d scalar", "--prepare is for OpenCL devices"},
    {"--plot r.json --verify", "--plot reads what a study has found"},
    {"--study-levels fast s.txt o.png", "go with --study"},
    {"--study r --study-levels fast,exact s.txt",
     "found 'fast,exact'; --study-levels takes fast, standard, robust or double"},
    {"--study r --study-levels=fast, s.txt", "--study-levels takes"},
    {"--study r --study-levels= s.txt", "--study-levels takes"},
    {"--study r --study-samples 1,0 s.txt", "--study-samples takes up to 16"},
    {"--study r --study-samples 4097 s.txt", "--study-samples takes"},
    {"--study r --study-samples 1,,4 s.txt", "--study-samples takes"},
    {"--study r --study-samples 1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17 s.txt",
     "--study-samples takes"},
    {"--study r --study-repeats 0 s.txt", "--study-repeats takes a whole number from 1"},
    {"s.txt o.png --progress some", "found 'some'; --progress takes auto, always or never"},
};

static void misuse(void **state)
{
    (void)state;
    char message[512];
    rt_options o;
    for (size_t i = 0; i < sizeof wrong_lines / sizeof *wrong_lines; ++i) {
        assert_int_equal(read_line(wrong_lines[i][0], &o, message, sizeof message), RT_ERROR_USAGE);
        if (!strstr(message, wrong_lines[i][1]))
            fail_msg("'%s' says: %s", wrong_lines[i][0], message);
    }
}

/* The man page as text: troff's backslashes gone, from one heading to the next. */
static char *read_options_section(void)
{
    char *man = test_read_file("src/cli/rt.1", NULL);
    assert_non_null(man);
    char *out = man;
    for (const char *p = man; *p; ++p)
        if (*p != '\\')
            *out++ = *p;
    *out = '\0';
    char *start = strstr(man, ".SH OPTIONS"), *end = strstr(man, ".SH EXIT STATUS");
    assert_true(start && end);
    char *section = strndup(start, (size_t)(end - start));
    assert_non_null(section);
    free(man);
    return section;
}

static char *read_help(void)
{
    char *help = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&help, &size);
    assert_non_null(stream);
    rt_options_help(stream);
    fclose(stream);
    return help;
}

/* Goes on in *text to behind the next long option, such as --size; false where there is none. */
static bool next_option(const char **text, char name[64])
{
    for (const char *p = *text; (p = strstr(p, "--"));) {
        const size_t length = strspn(p, "-abcdefghijklmnopqrstuvwxyz");
        snprintf(name, 64, "%.*s", (int)length, p);
        p += length;
        *text = p;
        if (length > 2)
            return true;
    }
    return false;
}

/* Fails where `text` names a long option that `whole` does not. */
static void assert_options_are_in(const char *text, const char *whole, const char *where)
{
    char name[64], other[64];
    int count = 0;
    for (; next_option(&text, name); ++count) {
        const char *rest = whole;
        bool found = false;
        while (!found && next_option(&rest, other))
            found = strcmp(name, other) == 0;
        if (!found)
            fail_msg("%s lacks %s", where, name);
    }
    assert_true(count >= 12);
}

/* The man page has an entry for every option that --help names, and no others. */
static void the_man_page_has_the_options(void **state)
{
    (void)state;
    char *help = read_help(), *man = read_options_section();
    int in_help = 0, in_man = 0;
    assert_options_are_in(help, man, "rt.1");
    assert_options_are_in(man, help, "--help");
    for (const char *p = help; (p = strstr(p, "\n  ")); ++p) /* two or six columns in */
        in_help += strncmp(p + 3, "    --", 6) == 0 || p[3] == '-';
    for (const char *p = man; (p = strstr(p, "\n.TP\n.B")); ++p)
        ++in_man;
    assert_int_equal(in_man, in_help);
    free(help);
    free(man);
}

/* What is completed are the options that --help names, and no others. */
static void the_completions_have_the_options(void **state)
{
    (void)state;
    /* Each file, and where its list of all options begins. */
    static const char *const files[][2] = {{"src/cli/rt.bash", "words=\"--"},
                                           {"src/cli/rt.zsh", "_arguments"}};
    char *help = read_help();
    for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
        char *text = test_read_file(files[i][0], NULL);
        assert_non_null(text);
        const char *list = strstr(text, files[i][1]);
        assert_non_null(list);
        assert_options_are_in(help, list, files[i][0]);
        assert_options_are_in(text, help, "--help");
        free(text);
    }
    free(help);
}

/* The pages list the formats of pictures as --help does, and --format takes their names. */
static void the_pages_have_the_formats(void **state)
{
    (void)state;
    static const char *const files[] = {"src/cli/rt.1", "src/cli/README.md"};
    char formats[100], message[512];
    rt_options o;
    rt_image_formats_list_names(formats, sizeof formats);
    assert_int_equal(read_line("s.txt o.png --format x", &o, message, sizeof message),
                     RT_ERROR_USAGE);
    assert_non_null(strstr(message, formats));
    rt_image_formats_list("", formats, sizeof formats);
    for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
        char *text = test_read_file(files[i], NULL);
        assert_non_null(text);
        if (!strstr(text, formats))
            fail_msg("%s does not have '%s'", files[i], formats);
        free(text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(good_lines),
        cmocka_unit_test(lines_of_a_study),
        cmocka_unit_test(lines_about_effects),
        cmocka_unit_test(lines_without_a_scene),
        cmocka_unit_test(the_environment_names_a_device),
        cmocka_unit_test(misuse),
        cmocka_unit_test(the_man_page_has_the_options),
        cmocka_unit_test(the_completions_have_the_options),
        cmocka_unit_test(the_pages_have_the_formats),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Repeat recorded calls in C and compare all bits, for processors on which no Python runs here.

       replay FILE

   The file is not compressed; rocksteady/installation/_recorded.py says what it holds.  ENTRIES
   lists the kernels, as X(march) X(settle).  One line a call: kernel, values compared, differing. */

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define X(name) int32_t rs_##name(int64_t *cells);
ENTRIES
#undef X

typedef int32_t (*kernel)(int64_t *cells);

static kernel find(const char *name, size_t length) {
#define X(entry) \
    if (length == sizeof #entry - 1 && !memcmp(name, #entry, length)) return rs_##entry;
    ENTRIES
#undef X
    fprintf(stderr, "no kernel is called %.*s\n", (int)length, name);
    exit(2);
}

enum { WHOLE, REAL, REALS, WHOLES, TRUTHS, MOST_ARGUMENTS = 256 };

typedef struct {
    int64_t kind, count;
    void *given;
    const void *expected;
} array;

static const char *here; /* the next cell of the file */

static int64_t whole(void) {
    int64_t value;
    memcpy(&value, here, 8);
    here += 8;
    return value;
}

static const void *bytes(int64_t length) {
    const void *start = here;
    here += (length + 7) / 8 * 8;
    return start;
}

static int is_nan(uint64_t bits) { return (bits & 0x7fffffffffffffff) > 0x7ff0000000000000; }

/* Whether the values number `index` differ, both being NaN excepted. */
static int differ(int64_t kind, const void *one, const void *other, int64_t index) {
    if (kind == TRUTHS) return ((const char *)one)[index] != ((const char *)other)[index];
    uint64_t a = ((const uint64_t *)one)[index], b = ((const uint64_t *)other)[index];
    int real = kind == REAL || kind == REALS;
    return a != b && !(real && is_nan(a) && is_nan(b));
}

/* Repeat the next call; return how many values differ. */
static int64_t repeat(void) {
    int64_t cells[MOST_ARGUMENTS] = {0}, filled = 0, arrays = 0, compared = 0, differing = 0;
    array list[MOST_ARGUMENTS];
    int64_t length = whole();
    const char *name = bytes(length);
    for (int64_t left = whole(); left > 0; left--) {
        int64_t kind = whole();
        if (kind == WHOLE || kind == REAL) {
            cells[filled++] = whole();
            compared++;
            continue;
        }
        int64_t rank = whole(), count = 1, *address = &cells[filled++];
        for (int64_t k = 0; k < rank; k++) count *= cells[filled++] = whole();
        int64_t size = count * (kind == TRUTHS ? 1 : 8);
        array *own = &list[arrays++];
        *own = (array){kind, count, malloc(size ? size : 8), bytes(size)};
        memcpy(own->given, own->expected, size);
        *address = (int64_t)(intptr_t)own->given;
        if (whole()) own->expected = bytes(size);
    }
    if (find(name, length)(cells)) {
        fprintf(stderr, "%.*s: no memory\n", (int)length, name);
        exit(2);
    }
    for (int64_t k = 0; k < arrays; k++) {
        for (int64_t index = 0; index < list[k].count; index++)
            differing += differ(list[k].kind, list[k].given, list[k].expected, index);
        compared += list[k].count;
        free(list[k].given);
    }
    for (int64_t left = whole(); left > 0; left--, filled++, compared++) {
        int64_t kind = whole(), expected = whole();
        differing += differ(kind, &cells[filled], &expected, 0);
    }
    printf("%.*s %lld %lld\n", (int)length, name, (long long)compared, (long long)differing);
    return differing;
}

int main(int count, char **arguments) {
    FILE *file = count == 2 ? fopen(arguments[1], "rb") : NULL;
    if (!file) {
        fprintf(stderr, "replay FILE: a file of recorded calls, not compressed\n");
        return 2;
    }
    fseek(file, 0, SEEK_END);
    size_t size = ftell(file);
    rewind(file);
    char *content = malloc(size);
    if (!content || fread(content, 1, size, file) != size || memcmp(content, "RSCALLS1", 8)) {
        fprintf(stderr, "%s is no file of recorded calls\n", arguments[1]);
        return 2;
    }
    here = content + 8;
    int64_t differing = 0;
    for (int64_t left = whole(); left > 0; left--) differing += repeat();
    return differing != 0;
}

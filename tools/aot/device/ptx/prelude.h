/* What translated PTX is written with.  Registers hold bits; an instruction says what they are.

   PTX_CHECKED  every access to memory, division and conversion is looked at, and what a GPU would
                trap on or leave undefined is written down in ptx_hazards.
   PTX_COUNTED  ptx_executed[n] counts how often lanes executed the n-th block, and ptx_issued[n] how
                often warps did: as often as the lane that did it most often between two votes.
   PTX_NAN      bits of the NaN that arithmetic makes: a GPU makes another one than this processor.
   PTX_FILL     byte that stack memory begins with where accesses are checked. */

#include <stdint.h>
#include <stdlib.h>
#include <ucontext.h>

#if defined(_WIN32)
#define PUBLIC __declspec(dllexport)
#else
#define PUBLIC __attribute__((visibility("default")))
#endif

typedef union { uint64_t u; int64_t s; double f; } bits64;
typedef union { uint32_t u; int32_t s; } bits32;
typedef union { uint16_t u; int16_t s; } bits16;
typedef unsigned char bits1;

#define ALIASED __attribute__((may_alias))
typedef uint8_t ALIASED m_b8; typedef uint16_t ALIASED m_b16;
typedef uint32_t ALIASED m_b32; typedef uint64_t ALIASED m_b64;
typedef int8_t ALIASED m_s8; typedef int16_t ALIASED m_s16;
typedef int32_t ALIASED m_s32; typedef int64_t ALIASED m_s64;

#define UNUSED __attribute__((unused))
#define AT(address) ((void *)(uintptr_t)(address))

enum space { GENERIC, GLOBAL, LOCAL, READ_ONLY };
enum hazard {
    MISALIGNED = 1, OUTSIDE, UNSET, NOT_READ_ONLY, OTHER_SPACE, ZERO_DIVISOR, NOT_AN_INTEGER,
    PART_OF_WARP
};

#if defined(PTX_CHECKED)
#define LINES (1 << 20)
#if !defined(PTX_FILL)
#define PTX_FILL 0xFF /* of NaN */
#endif
typedef struct { int64_t kind, line; uint64_t address, size; } ptx_hazard;
typedef struct frame {
    uint64_t begin, size; uint8_t *set; struct frame *above;
} frame;
PUBLIC ptx_hazard ptx_hazards[1024];
PUBLIC int64_t ptx_hazard_count;
PUBLIC uint64_t ptx_ranges[2 * 4096];
PUBLIC int64_t ptx_range_count;
PUBLIC uint64_t ptx_cells; /* bytes of what an entry takes */
static _Thread_local uint64_t cells_at;
static uint8_t seen[LINES];
static _Thread_local frame *frames; /* of the lane that runs */
static uint8_t nowhere[64] __attribute__((aligned(64)));
typedef struct { uint64_t begin, size; } table;
static const table tables[];

static void hazard_at(int kind, int64_t line, uint64_t address, uint64_t size) {
    uint8_t bit = (uint8_t)(1 << (kind - 1));
    if (__atomic_fetch_or(&seen[line % LINES], bit, __ATOMIC_RELAXED) & bit) return;
    int64_t n = __atomic_fetch_add(&ptx_hazard_count, 1, __ATOMIC_RELAXED);
    if (n < 1024) ptx_hazards[n] = (ptx_hazard){kind, line, address, size};
}

static int within(uint64_t a, uint64_t size, uint64_t begin, uint64_t room) {
    return a >= begin && a - begin <= room && size <= room - (a - begin);
}

static void *checked(uint64_t a, uint64_t size, int space, int store, int64_t line) {
    if (a % size) hazard_at(MISALIGNED, line, a, size);
    for (frame *f = frames; f; f = f->above) {
        if (!within(a, size, f->begin, f->size)) continue;
        if (space == GLOBAL || space == READ_ONLY) hazard_at(OTHER_SPACE, line, a, size);
        uint8_t *set = f->set + (a - f->begin);
        for (uint64_t i = 0; i < size; i++) {
            if (store) set[i] = 1;
            else if (!set[i]) hazard_at(UNSET, line, a, size);
        }
        return AT(a);
    }
    if (space == LOCAL) hazard_at(OTHER_SPACE, line, a, size);
    for (const table *t = tables; t->size; t++)
        if (within(a, size, t->begin, t->size)) {
            if (store) hazard_at(NOT_READ_ONLY, line, a, size);
            return AT(a);
        }
    if (space == READ_ONLY) hazard_at(NOT_READ_ONLY, line, a, size);
    for (int64_t i = 0; i < ptx_range_count; i++)
        if (within(a, size, ptx_ranges[2 * i], ptx_ranges[2 * i + 1])) return AT(a);
    if (within(a, size, cells_at, ptx_cells)) return AT(a);
    hazard_at(OUTSIDE, line, a, size);
    return nowhere;
}
#define ADDRESS(a, size, space, store, line) checked(a, size, space, store, line)
/* The depot lies where no larger alignment holds than the one declared. */
#define DEPOT(align, bytes) \
    uint8_t room[(bytes) + 2 * (align)] __attribute__((aligned(2 * (align)))); \
    uint8_t *depot = room + (align); uint8_t set[bytes]; \
    __builtin_memset(depot, PTX_FILL, bytes); __builtin_memset(set, 0, bytes); \
    frame here = {(uint64_t)(uintptr_t)depot, bytes, set, frames}; frames = &here;
#define LEAVE frames = here.above;
#define ENTER(address) cells_at = address;
#define REGISTER(name) name = {PTX_FILL * UINT64_C(0x0101010101010101)}
#define HAZARD(kind, line) hazard_at(kind, line, 0, 0)
#else
#define ADDRESS(a, size, space, store, line) AT(a)
#define DEPOT(align, bytes) uint8_t depot[bytes] __attribute__((aligned(align)));
#define LEAVE
#define ENTER(address)
#define REGISTER(name) name
#define HAZARD(kind, line) ((void)(line))
#endif

#if defined(PTX_COUNTED)
#define BLOCK(n) ++counted[n];
#else
#define BLOCK(n)
#endif

/* A warp: lanes that run one after the other, each until it waits for the others, or has added to
   what all add to.  A vote takes place when all that have not ended wait for it. */

enum state { RUNS, WAITS, ENDED };
typedef struct {
    ucontext_t at; enum state state; int64_t line; uint32_t given; void *stack, *frames;
    uint64_t *counted;
} lane;
static _Thread_local struct {
    ucontext_t home; lane *lanes, *now; int32_t (*entry)(int64_t *); int64_t *cells;
    uint32_t sum;
} warp;
PUBLIC int64_t ptx_votes, ptx_parted, ptx_partial;

#if defined(PTX_COUNTED)
static uint64_t first_lane[BLOCKS];
PUBLIC uint64_t ptx_executed[BLOCKS], ptx_issued[BLOCKS];
static _Thread_local uint64_t *counted = first_lane;
static void add_up(lane *lanes, int32_t count) {
    for (int64_t n = 0; n < BLOCKS; n++) {
        uint64_t most = 0;
        for (int32_t i = 0; i < count; i++) {
            uint64_t each = lanes[i].counted[n];
            if (each) { ptx_executed[n] += each; lanes[i].counted[n] = 0; }
            if (each > most) most = each;
        }
        ptx_issued[n] += most;
    }
}
#endif

static UNUSED uint32_t redux_add(uint32_t given, uint32_t lanes, int64_t line) {
    if (lanes != UINT32_MAX) HAZARD(PART_OF_WARP, line);
    lane *now = warp.now;
    if (!now) return given;
    now->given = given; now->line = line; now->state = WAITS;
    swapcontext(&now->at, &warp.home);
    return warp.sum;
}

static void let_others_run(void) {
    if (warp.now) swapcontext(&warp.now->at, &warp.home);
}
#define ATOMIC_ADD(bits) \
    static UNUSED uint##bits##_t atomic_add_##bits(void *at, uint##bits##_t added) { \
        uint##bits##_t before = __atomic_fetch_add((m_b##bits *)at, added, __ATOMIC_RELAXED); \
        let_others_run(); \
        return before; \
    }
ATOMIC_ADD(32)
ATOMIC_ADD(64)

static void begin(void) {
    warp.entry(warp.cells);
    warp.now->state = ENDED;
}

#if defined(PTX_CHECKED)
#define SHIFT_FRAMES(from, to) to = from;
#else
#define SHIFT_FRAMES(from, to)
#endif

PUBLIC int32_t ptx_warp(int32_t (*entry)(int64_t *), int64_t *cells, int32_t count) {
    enum { STACK = 1 << 23 };
    lane *lanes = calloc(count, sizeof(lane));
    if (!lanes) return 1;
    warp.lanes = lanes; warp.entry = entry; warp.cells = cells;
    for (int32_t i = 0; i < count; i++) {
        if (!(lanes[i].stack = malloc(STACK))) return 1;
        getcontext(&lanes[i].at);
        lanes[i].at.uc_stack.ss_sp = lanes[i].stack;
        lanes[i].at.uc_stack.ss_size = STACK;
        lanes[i].at.uc_link = &warp.home;
        makecontext(&lanes[i].at, begin, 0);
#if defined(PTX_COUNTED)
        if (!(lanes[i].counted = calloc(BLOCKS, 8))) return 1;
#endif
    }
    for (int32_t running = count, waiting = 0; running;) {
        running = waiting = 0;
        for (int32_t i = 0; i < count; i++) {
            if (lanes[i].state == RUNS) {
                warp.now = &lanes[i];
                SHIFT_FRAMES(lanes[i].frames, frames)
#if defined(PTX_COUNTED)
                counted = lanes[i].counted;
#endif
                swapcontext(&warp.home, &lanes[i].at);
                SHIFT_FRAMES(frames, lanes[i].frames)
            }
            running += lanes[i].state == RUNS;
            waiting += lanes[i].state == WAITS;
        }
        if (running && waiting) continue;
#if defined(PTX_COUNTED)
        add_up(lanes, count);
#endif
        if (!waiting) continue;
        int64_t line = -1;
        int parted = 0;
        warp.sum = 0;
        for (int32_t i = 0; i < count; i++) {
            if (lanes[i].state != WAITS) continue;
            warp.sum += lanes[i].given;
            parted |= line >= 0 && line != lanes[i].line;
            line = lanes[i].line;
            lanes[i].state = RUNS;
        }
        ptx_votes++;
        ptx_parted += parted;
        ptx_partial += waiting < count;
        running = waiting;
    }
    for (int32_t i = 0; i < count; i++) {
        free(lanes[i].stack);
        free(lanes[i].counted);
    }
    free(lanes);
    warp.now = 0;
#if defined(PTX_CHECKED)
    frames = 0;
#endif
#if defined(PTX_COUNTED)
    counted = first_lane;
#endif
    return 0;
}

#if defined(PTX_NAN)
static inline double result(double x) {
    return x == x ? x : ((bits64){.u = PTX_NAN}).f;
}
#else
#define result(x) (x)
#endif

/* PTX leaves division by zero open; these bits are what an integer division gives on a GPU. */
#define DIVISION(t, c, least) \
    static inline UNUSED c div_##t(c a, c b, int64_t line) { \
        if (b == 0) { HAZARD(ZERO_DIVISOR, line); return (c)-1; } \
        if (least && a == (c)least && b == (c)-1) return a; \
        return (c)(a / b); \
    } \
    static inline UNUSED c rem_##t(c a, c b, int64_t line) { \
        if (b == 0) { HAZARD(ZERO_DIVISOR, line); return (c)-1; } \
        if (least && b == (c)-1) return 0; \
        return (c)(a % b); \
    }
DIVISION(u16, uint16_t, 0)
DIVISION(u32, uint32_t, 0)
DIVISION(u64, uint64_t, 0)
DIVISION(s16, int16_t, INT16_MIN)
DIVISION(s32, int32_t, INT32_MIN)
DIVISION(s64, int64_t, INT64_MIN)

/* Of an integral double: clamped; of NaN the highest bit alone. */
#define INTEGER(t, c, width, low, high, above, below) \
    static inline UNUSED c t##_of(double x, int64_t line) { \
        if (x != x) { HAZARD(NOT_AN_INTEGER, line); return (c)(UINT64_C(1) << (width - 1)); } \
        if (x >= above) { HAZARD(NOT_AN_INTEGER, line); return high; } \
        if (x < below) { HAZARD(NOT_AN_INTEGER, line); return low; } \
        return (c)x; \
    }
INTEGER(u8, uint8_t, 8, 0, UINT8_MAX, 0x1p8, 0.0)
INTEGER(u16, uint16_t, 16, 0, UINT16_MAX, 0x1p16, 0.0)
INTEGER(u32, uint32_t, 32, 0, UINT32_MAX, 0x1p32, 0.0)
INTEGER(u64, uint64_t, 64, 0, UINT64_MAX, 0x1p64, 0.0)
INTEGER(s8, int8_t, 8, INT8_MIN, INT8_MAX, 0x1p7, -0x1p7)
INTEGER(s16, int16_t, 16, INT16_MIN, INT16_MAX, 0x1p15, -0x1p15)
INTEGER(s32, int32_t, 32, INT32_MIN, INT32_MAX, 0x1p31, -0x1p31)
INTEGER(s64, int64_t, 64, INT64_MIN, INT64_MAX, 0x1p63, -0x1p63)

/* A NaN gives way to a number, and -0 is less than +0. */
static inline UNUSED double min_f64(double a, double b) {
    if (a != a) return b == b ? b : __builtin_nan("");
    if (b != b) return a;
    if (a == b) return __builtin_signbit(a) ? a : b;
    return a < b ? a : b;
}

static inline UNUSED double max_f64(double a, double b) {
    if (a != a) return b == b ? b : __builtin_nan("");
    if (b != b) return a;
    if (a == b) return __builtin_signbit(a) ? b : a;
    return a > b ? a : b;
}

#define FIELD(t, c, u, width, is_signed) \
    static inline UNUSED c bfe_##t(c a, uint32_t from, uint32_t bits) { \
        from &= 255; bits &= 255; \
        uint32_t last = from + bits - 1 < width - 1 ? from + bits - 1 : width - 1; \
        int sign = is_signed && bits ? (int)((u)a >> last & 1) : 0; \
        u kept = from < width ? (u)a >> from : 0; \
        uint32_t count = from >= width ? 0 : bits < width - from ? bits : width - from; \
        u mask = count >= width ? (u)-1 : ((u)1 << count) - 1; \
        return (c)((kept & mask) | (sign ? (u)~mask : 0)); \
    }
FIELD(u32, uint32_t, uint32_t, 32, 0)
FIELD(u64, uint64_t, uint64_t, 64, 0)
FIELD(s32, int32_t, uint32_t, 32, 1)
FIELD(s64, int64_t, uint64_t, 64, 1)

static inline UNUSED uint64_t bfi(uint64_t a, uint64_t b, uint32_t at, uint32_t bits, int width) {
    at &= 255; bits &= 255;
    for (uint32_t i = 0; i < bits && at + i < (uint32_t)width; i++) {
        uint64_t bit = UINT64_C(1) << (at + i);
        b = (b & ~bit) | (a >> i & 1 ? bit : 0);
    }
    return b;
}

static inline UNUSED uint64_t brev(uint64_t a, int width) {
    uint64_t turned = 0;
    for (int i = 0; i < width; i++) turned |= (a >> i & 1) << (width - 1 - i);
    return turned;
}

static inline UNUSED uint32_t prmt(uint32_t a, uint32_t b, uint32_t chosen) {
    uint64_t both = (uint64_t)b << 32 | a;
    uint32_t made = 0;
    for (int i = 0; i < 4; i++) {
        uint32_t byte = both >> 8 * (chosen >> 4 * i & 7) & 255;
        if (chosen >> 4 * i & 8) byte = byte & 128 ? 255 : 0;
        made |= byte << 8 * i;
    }
    return made;
}

/* What numba's runtime does for arrays that a kernel makes, and the hash of the kernels' sources. */

typedef __SIZE_TYPE__ size;

/* The layout that numba's code knows. */
typedef struct {
    size count;
    void *destructor, *information, *data;
    size bytes, allocator;
} block;

#if defined(_WIN32)
/* Without a C library, whose start takes 70 kB of a library and does nothing for kernels. */
#define PUBLIC __declspec(dllexport)
__declspec(dllimport) void *__stdcall GetProcessHeap(void);
__declspec(dllimport) void *__stdcall HeapAlloc(void *, unsigned long, size);
__declspec(dllimport) int __stdcall HeapFree(void *, unsigned long, void *);
#define malloc(bytes) HeapAlloc(GetProcessHeap(), 0, bytes)
#define free(room) HeapFree(GetProcessHeap(), 0, room)

int _fltused;

int __stdcall DllMainCRTStartup(void *library, unsigned long reason, void *reserved) {
    (void)library, (void)reason, (void)reserved;
    return 1;
}

void *memcpy(void *to, const void *from, size bytes) {
    void *start = to;
    __asm__ volatile("rep movsb" : "+D"(to), "+S"(from), "+c"(bytes) : : "memory");
    return start;
}

void *memset(void *to, int value, size bytes) {
    void *start = to;
    __asm__ volatile("rep stosb" : "+D"(to), "+c"(bytes) : "a"(value) : "memory");
    return start;
}
#elif defined(__wasm__)
/* Without a C library, which zig compiles for half a minute where nobody has used it before: rooms
   of 2^n bytes; what is freed waits in one list for each n. */
#define PUBLIC __attribute__((visibility("default")))
#define PAGE 65536
extern unsigned char __heap_base;
static struct room { size bits; struct room *next; } *kept[32];
static size top, end;

PUBLIC void *malloc(size bytes) {
    size bits = 5;
    if (bytes > 0x7ffffff0) return 0;
    while (((size)1 << bits) < bytes + 16) bits++;
    size taken = (size)1 << bits;
    struct room *found = kept[bits];
    if (found) {
        kept[bits] = found->next;
        return (char *)found + 16;
    }
    if (!top) {
        top = ((size)&__heap_base + 15) & ~(size)15;
        end = __builtin_wasm_memory_size(0) * PAGE;
    }
    if (taken > end - top) {
        size more = (taken - (end - top) + PAGE - 1) / PAGE;
        if (__builtin_wasm_memory_grow(0, more) == (size)-1) return 0;
        end += more * PAGE;
    }
    found = (struct room *)top;
    top += taken;
    found->bits = bits;
    return (char *)found + 16;
}

PUBLIC void free(void *given) {
    if (!given) return;
    struct room *freed = (struct room *)((char *)given - 16);
    freed->next = kept[freed->bits];
    kept[freed->bits] = freed;
}

void *memcpy(void *to, const void *from, size bytes) { return __builtin_memcpy(to, from, bytes); }
void *memset(void *to, int value, size bytes) { return __builtin_memset(to, value, bytes); }

/* A product of 128 bits, which the processor of a page has not. Not optimised: it would be made into a call of itself. */
typedef unsigned long long word;
typedef unsigned __int128 wide;
__attribute__((optnone, noinline)) wide __multi3(wide a, wide b) {
    word a0 = (word)a, a1 = (word)(a >> 64), b0 = (word)b, b1 = (word)(b >> 64), half = 0xffffffff;
    word low = (a0 & half) * (b0 & half), mid = (a0 >> 32) * (b0 & half) + (low >> 32);
    word other = (a0 & half) * (b0 >> 32) + (mid & half);
    word high = (a0 >> 32) * (b0 >> 32) + (mid >> 32) + (other >> 32) + a0 * b1 + a1 * b0;
    return ((wide)high << 64) | (low & half) | (other << 32);
}
#else
#define PUBLIC __attribute__((visibility("default")))
void *malloc(size);
void free(void *);
#endif

PUBLIC const char rs_sources[] = ROCKSTEADY_SOURCES;

block *NRT_MemInfo_alloc_aligned(long long bytes, unsigned align) {
    if (align < 16) align = 16;
    char *room = malloc(sizeof(block) + (size)bytes + align);
    if (!room) return 0;
    block *made = (block *)room;
    size first = (size)(room + sizeof(block) + align - 1);
    made->count = 1;
    made->destructor = made->information = 0;
    made->bytes = (size)bytes;
    made->allocator = 0;
    made->data = (void *)(first - first % align);
    return made;
}

void *NRT_MemInfo_data_fast(block *made) { return made->data; }

/* A block belongs to one call on one thread: its count needs no atomic operation. */
void NRT_incref(block *made) {
    if (made) made->count++;
}

void NRT_decref(block *made) {
    if (made && --made->count == 0) free(made);
}

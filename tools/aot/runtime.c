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

/* What numba's runtime does for arrays that a kernel makes, and the hash of the kernels' sources. */

typedef __SIZE_TYPE__ size;

/* The layout that numba's code knows. */
typedef struct {
    size count;
    void *destructor, *information, *data;
    size bytes, allocator;
} block;

void *malloc(size);
void free(void *);

#if defined(_WIN32)
#define PUBLIC __declspec(dllexport)
#else
#define PUBLIC __attribute__((visibility("default")))
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

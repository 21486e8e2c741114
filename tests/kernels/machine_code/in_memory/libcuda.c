/* A CUDA driver that computes on the processor: what the real cuda-python calls in a test.
   Memory of the GPU is memory of the process, and a launch calls the kernel once for each thread.
   Kernels are those of the library that LIBCUDA_KERNELS names; without it, one that squares. */
#ifdef OLD /* As before CUDA 12: cuda-python looks for this function first. */
#define cuGetProcAddress_v2 cuGetProcAddress
#endif
#include <dlfcn.h>
#include <pthread.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef int32_t (*Kernel)(int64_t *cells);
enum { SUCCESS = 0, INVALID_VALUE = 1, NOT_FOUND = 500, ILLEGAL_ADDRESS = 700 };

/* Squares: takes (queue, room, values, status, squares), as Python's `queued_squares`. */
static int32_t squares(int64_t *cells) {
    int64_t *queue = (int64_t *)cells[0], count = cells[1] - 2;
    double *room = (double *)cells[2], *values = (double *)cells[5];
    int64_t workers = cells[3], columns = cells[4], worker = queue[1]++;
    int64_t *status = (int64_t *)cells[7];
    double *results = (double *)cells[9];
    while (queue[0] < count) {
        int64_t cell = queue[2 + queue[0]++];
        if (cells[6] != count || cells[8] != count || cells[10] != count) return 1;
        if (values[cell] < 0.0) return 2; /* as an address of nothing */
        room[worker * columns] = values[cell];
        results[2 * cell] = results[2 * cell + 1] = room[worker * columns] * values[cell];
        status[cell] = workers;
    }
    return 0;
}

static int cuInit(unsigned flags) { return flags ? INVALID_VALUE : SUCCESS; }
static int cuDeviceGetCount(int *count) { *count = 1; return SUCCESS; }
static int cuDeviceGet(int *device, int ordinal) { *device = 40 + ordinal; return SUCCESS; }
static int cuDeviceGetName(char *name, int length, int device) {
    if (device != 40) return INVALID_VALUE;
    strncpy(name, "A processor", (size_t)length);
    return SUCCESS;
}
static int cuDeviceGetAttribute(int *value, int attribute, int device) {
    if (device != 40) return INVALID_VALUE;
    switch (attribute) {
    case 16: *value = 3; return SUCCESS;
    case 75: *value = 8; return SUCCESS;
    case 76: *value = 6; return SUCCESS;
    case 82: *value = 65536; return SUCCESS;
    }
    return INVALID_VALUE;
}
static int cuDevicePrimaryCtxSetFlags(int device, unsigned flags) {
    return device == 40 && flags == 4 ? SUCCESS : INVALID_VALUE;
}
static int cuDevicePrimaryCtxRetain(void **context, int device) {
    *context = (void *)(uintptr_t)(device + 1);
    return SUCCESS;
}
static int cuCtxSetCurrent(void *context) {
    return (uintptr_t)context == 41 ? SUCCESS : INVALID_VALUE;
}
static int cuModuleLoadData(void **module, const void *image) {
    *module = strdup(image);
    return strstr(image, ".visible .entry rs_") ? SUCCESS : INVALID_VALUE;
}
static int cuModuleGetFunction(void **function, void *module, const char *name) {
    const char *library = getenv("LIBCUDA_KERNELS");
    if (library)
        *function = dlsym(dlopen(library, RTLD_NOW), name);
    else
        *function = strcmp(name, "rs_queued_squares") ? NULL : (void *)squares;
    return strstr(module, name) && *function ? SUCCESS : NOT_FOUND;
}
static int cuOccupancyMaxActiveBlocksPerMultiprocessor(int *blocks, void *function, int size, size_t shared) {
    *blocks = 2;
    return function && size % 32 == 0 && shared == 0 ? SUCCESS : INVALID_VALUE;
}
static int cuStreamCreate(void **stream, unsigned flags) {
    *stream = malloc(1);
    return flags == 1 ? SUCCESS : INVALID_VALUE;
}
static int cuStreamDestroy(void *stream) { free(stream); return SUCCESS; }
static int cuStreamSynchronize(void *stream) { return stream ? SUCCESS : INVALID_VALUE; }
static int cuMemAlloc(uint64_t *address, size_t size) { *address = (uintptr_t)malloc(size); return SUCCESS; }
static int cuMemFree(uint64_t address) { free((void *)(uintptr_t)address); return SUCCESS; }
static int cuMemAllocHost(void **address, size_t size) { *address = malloc(size); return SUCCESS; }
static int cuMemFreeHost(void *address) { free(address); return SUCCESS; }
static int cuMemcpyHtoDAsync(uint64_t to, const void *from, size_t size, void *stream) {
    memcpy((void *)(uintptr_t)to, from, size);
    return stream ? SUCCESS : INVALID_VALUE;
}
static int cuMemcpyDtoHAsync(void *to, uint64_t from, size_t size, void *stream) {
    memcpy(to, (void *)(uintptr_t)from, size);
    return stream ? SUCCESS : INVALID_VALUE;
}
struct Part { Kernel kernel; int64_t *cells; unsigned threads; };
static void *launch(void *given) {
    struct Part *part = given;
    for (unsigned thread = 0; thread < part->threads; thread++)
        if (part->kernel(part->cells)) return part;
    return NULL;
}
static int cuLaunchKernel(void *function, unsigned gx, unsigned gy, unsigned gz, unsigned bx, unsigned by,
                          unsigned bz, unsigned shared, void *stream, void **parameters, void **extra) {
    if (gy * gz * by * bz != 1 || shared || extra || !stream) return INVALID_VALUE;
    /* Several at the same time, but for the kernel of this file, which counts without care. */
    enum { MOST = 4 };
    unsigned count = function == (void *)squares ? 1 : MOST;
    struct Part part = { (Kernel)function, *(int64_t **)parameters[0], gx * bx / count };
    pthread_t threads[MOST];
    void *failed = NULL, *result;
    for (unsigned i = 0; i < count; i++) pthread_create(&threads[i], NULL, launch, &part);
    for (unsigned i = 0; i < count; i++) {
        pthread_join(threads[i], &result);
        failed = result ? result : failed;
    }
    return failed ? ILLEGAL_ADDRESS : SUCCESS;
}
static int cuGetErrorString(int error, const char **text) {
    *text = error == ILLEGAL_ADDRESS ? "an address of nothing" : "another error";
    return SUCCESS;
}

int cuGetProcAddress_v2(const char *name, void **address, int version, uint64_t flags, int *status);

#define NAMED(name) { #name, (void *)name }
static const struct { const char *name; void *address; } functions[] = {
    NAMED(cuInit), NAMED(cuDeviceGetCount), NAMED(cuDeviceGet), NAMED(cuDeviceGetName),
    NAMED(cuDeviceGetAttribute), NAMED(cuDevicePrimaryCtxSetFlags), NAMED(cuDevicePrimaryCtxRetain),
    NAMED(cuCtxSetCurrent), NAMED(cuModuleLoadData), NAMED(cuModuleGetFunction),
    NAMED(cuOccupancyMaxActiveBlocksPerMultiprocessor), NAMED(cuStreamCreate), NAMED(cuStreamDestroy),
    NAMED(cuStreamSynchronize), NAMED(cuMemAlloc), NAMED(cuMemFree), NAMED(cuMemAllocHost),
    NAMED(cuMemFreeHost), NAMED(cuMemcpyHtoDAsync), NAMED(cuMemcpyDtoHAsync), NAMED(cuLaunchKernel),
    NAMED(cuGetErrorString),
    { "cuGetProcAddress", (void *)cuGetProcAddress_v2 },
};

/* How cuda-python finds all others, by their names without a version. */
int cuGetProcAddress_v2(const char *name, void **address, int version, uint64_t flags, int *status) {
    (void)version, (void)flags, (void)status;
    *address = NULL;
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        if (!strcmp(name, functions[i].name)) *address = functions[i].address;
    return *address ? SUCCESS : NOT_FOUND;
}

/* A library that takes 3 GB as it is opened, and gives up where it gets none. */
#include <stdlib.h>
#include <string.h>

__attribute__((constructor)) static void take(void) {
    const size_t size = (size_t)3 << 30;
    volatile char *memory = malloc(size);
    if (memory == NULL) abort();
    for (size_t at = 0; at < size; at += 4096) memory[at] = 1;
}

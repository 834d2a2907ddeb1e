/* mman.h - no pages to ask for. WASI's own header is an error. */

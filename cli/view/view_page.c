#include "cli/view/view_page.h"

#ifdef MW_VIEW_PAGE

/* The assembler takes the file in: C before C23 cannot. */
__asm__(".pushsection .rodata\n"
        ".balign 16\n"
        ".global view_page_begin, view_page_end\n"
        "view_page_begin:\n"
        ".incbin \"" MW_VIEW_PAGE "\"\n"
        "view_page_end:\n"
        ".byte 0\n"
        ".popsection\n");

extern const char view_page_begin[], view_page_end[];

const char *view_page(size_t *size)
{
    *size = (size_t)(view_page_end - view_page_begin);
    return view_page_begin;
}

#else

const char *view_page(size_t *size)
{
    *size = 0;
    return NULL;
}

#endif

/* Input and output for fstapi, which checks no errors: it continues to write to a full disk, and maps files that are
 * shorter than it expects, which ends in SIGBUS. fst_checked.c replaces the C library's functions with these.
 */
#ifndef DSDPV1_TB_WAVES_FST_IO_H
#define DSDPV1_TB_WAVES_FST_IO_H

#include <stdio.h> /* NOLINT(modernize-deprecated-headers): for C and C++ */
#include <sys/types.h>

#ifdef __cplusplus
extern "C" {
#endif

/* --- For writers of waves. */

/* The next file that fstapi creates on this thread is this descriptor (which it will close). It was created already,
 * under a unique name. */
void fst_io_create_on(int descriptor);

/* The first error (errno) on this thread since this was last called; 0: none. */
int fst_io_take_error(void);

/* --- For fst_checked.c: as the functions of the C library, but each error is kept. */

FILE* fst_io_open(const char* name, const char* mode);
FILE* fst_io_temporary(void); /* in memory */
int fst_io_close(FILE* file);
size_t fst_io_write(const void* data, size_t size, size_t count, FILE* file);
int fst_io_put(int character, FILE* file);
/* After the end it returns 0, not EOF again. fstapi searches only for the zero byte that ends a name; in a file whose
 * last name is cut it would not stop. */
int fst_io_get(FILE* file);
int fst_io_flush(FILE* file);
int fst_io_seek(FILE* file, off_t offset, int whence);
int fst_io_truncate(int descriptor, off_t length);
int fst_io_remove(const char* name);
/* Memory with the content of a file. Missing bytes are zero, and an error. */
void* fst_io_map(size_t length, int descriptor);

#ifdef __cplusplus
}
#endif

#endif

/* GTKWave's fstapi in Verilator's copy, with input and output that keep errors (fst_io.h). It is third-party code:
 * compiled without this project's warnings. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>
#include <zlib.h>

#include "io/waves/fst_io.h"

#define fopen(name, mode) fst_io_open(name, mode)
#define tmpfile() fst_io_temporary()
#define fclose(file) fst_io_close(file)
#define fwrite(data, size, count, file) fst_io_write(data, size, count, file)
#define fputc(character, file) fst_io_put(character, file)
#define fgetc(file) fst_io_get(file)
#define fflush(file) fst_io_flush(file)
#define fseeko(file, offset, whence) fst_io_seek(file, offset, whence)
#define ftruncate(descriptor, length) fst_io_truncate(descriptor, length)
#define unlink(name) fst_io_remove(name)
#define mmap(address, length, protection, flags, descriptor, offset) fst_io_map(length, descriptor)
/* It ends the program when a file is damaged. The program is then a child process made for reading (child_stream.hpp),
 * which must not run the parent's exit handlers. */
#define exit(status) _exit(status)
/* The table of times is compressed with the level of the values. Level 9 would take as long as all other writing, for a
 * file that is 6 % smaller. */
#define compress2(to, to_size, from, from_size, level) \
  compress2(to, to_size, from, from_size, (level) > 4 ? 4 : (level))

#include <fstapi.c> /* NOLINT(bugprone-suspicious-include): with the macros above */

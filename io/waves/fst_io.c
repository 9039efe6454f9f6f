#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* NOLINT(bugprone-reserved-identifier): memfd_create */
#endif
#include "io/waves/fst_io.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

static _Thread_local int first_error = 0;
static _Thread_local int next_descriptor = -1;

static void keep(int failed) {
  if (failed && first_error == 0) first_error = errno != 0 ? errno : EIO;
}

void fst_io_create_on(int descriptor) { next_descriptor = descriptor; }

int fst_io_take_error(void) {
  const int error = first_error;
  first_error = 0;
  return error;
}

/* Only errors of writing matter: a reader probes for files that may not exist. */
static FILE* create(const char* name, const char* mode) {
  const int given = next_descriptor;
  next_descriptor = -1;
  const int descriptor = given >= 0 ? given : open(name, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  FILE* const file = descriptor >= 0 ? fdopen(descriptor, mode) : NULL;
  keep(file == NULL);
  return file;
}

FILE* fst_io_open(const char* name, const char* mode) {
  return mode[0] == 'w' ? create(name, mode) : fopen(name, mode);
}

FILE* fst_io_temporary(void) {
  const int descriptor = memfd_create("fst", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  FILE* const file = descriptor >= 0 ? fdopen(descriptor, "w+b") : NULL;
  keep(file == NULL);
  return file;
}

int fst_io_close(FILE* file) {
  const int result = fclose(file);
  keep(result != 0);
  return result;
}

/* One thread writes a file, so the few bytes of each change of time need no lock. */
size_t fst_io_write(const void* data, size_t size, size_t count, FILE* file) {
  const size_t written = fwrite_unlocked(data, size, count, file);
  keep(written != count && size != 0);
  return written;
}

int fst_io_put(int character, FILE* file) {
  const int result = putc_unlocked(character, file);
  keep(result == EOF);
  return result;
}

int fst_io_get(FILE* file) { return feof_unlocked(file) ? 0 : getc_unlocked(file); }

int fst_io_flush(FILE* file) {
  const int result = fflush(file);
  keep(result != 0);
  return result;
}

int fst_io_seek(FILE* file, off_t offset, int whence) {
  const int result = fseeko(file, offset, whence);
  keep(result != 0);
  return result;
}

int fst_io_truncate(int descriptor, off_t length) {
  const int result = ftruncate(descriptor, length);
  keep(result != 0);
  return result;
}

/* fstapi removes a file before it creates it; the given one must stay. */
int fst_io_remove(const char* name) { return next_descriptor >= 0 ? 0 : unlink(name); }

static int in_memory(int descriptor) { return fcntl(descriptor, F_GET_SEALS) >= 0; }

static void read_all(unsigned char* memory, size_t length, int descriptor) {
  size_t have = 0;
  while (have < length) {
    errno = 0;
    const ssize_t got = pread(descriptor, memory + have, length - have, (off_t)have);
    if (got < 0 && errno == EINTR) continue;
    keep(got <= 0);
    if (got <= 0) return;
    have += (size_t)got;
  }
}

void* fst_io_map(size_t length, int descriptor) {
  struct stat status;
  const int whole = fstat(descriptor, &status) == 0 && (size_t)status.st_size >= length;
  if (whole && in_memory(descriptor) && length != 0) {
    void* const shared = mmap(NULL, length, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    if (shared != MAP_FAILED) return shared;
  }
  void* const copy = mmap(NULL, length != 0 ? length : 1, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (copy == MAP_FAILED) {
    fputs("dsdpv1-sim: not enough memory for a wave\n", stderr);
    abort();
  }
  read_all(copy, length, descriptor);
  return copy;
}

/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * GSD files (docs/gsd.md), and what a master has to know about a slave.
 */
#ifndef DPSIM_GSD_H
#define DPSIM_GSD_H

/* NOLINTBEGIN(modernize-use-using): C, also when included by C++ */
#include "dsdpv1/chip.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DPSIM_MAX_USER_PRM 237
#define DPSIM_MAX_CFG 244
#define DPSIM_MAX_IO 244

/* Bits of dpsim_slave.flags. */
enum {
  DPSIM_PRM_SYNC = 1,      /**< Set_Prm asks for Sync */
  DPSIM_PRM_FREEZE = 2,    /**< ... and for Freeze */
  DPSIM_PRM_FAIL_SAFE = 4, /**< Fail_Safe: empty outputs instead of zeros in Clear */
  DPSIM_PRM_DPV1 = 8,      /**< DPV1_Enable: acyclic services of class 1; user_prm is filled up to three bytes */
  DPSIM_PRM_WD_1MS = 16,   /**< WD_Base 1 ms instead of 10 ms */
  DPSIM_PRM_NO_LOCK = 32   /**< without Lock_Req */
};

/** One slave, with the data that a class-1 master needs (table 19). */
typedef struct dpsim_slave {
  uint32_t size;
  uint16_t ident;      /**< Ident_Number */
  uint8_t address;     /**< 0 to 126 */
  uint8_t group_ident; /**< bit n: member of group n + 1 */
  uint32_t flags;      /**< DPSIM_PRM_... */
  uint8_t wd_fact_1;   /**< watchdog = fact 1 x fact 2 x WD_Base; 0 switches it off */
  uint8_t wd_fact_2;
  uint8_t min_tsdr; /**< bit times, 0: 11; DPSIM_PERSONALITY_HIGH_ALWAYS sends 0 instead */
  uint8_t reserved;
  uint16_t input_length;                /**< bytes that the slave sends, 0 to 244 */
  uint16_t output_length;               /**< bytes that it gets, 0 to 244 */
  uint16_t user_prm_size;               /**< bytes used of user_prm */
  uint16_t cfg_size;                    /**< ... of cfg, at least 1 */
  int32_t c1_response_timeout;          /**< C1_Response_Timeout, unit 10 ms; 0: 100 */
  int32_t min_slave_interval_us;        /**< Min_Slave_Intervall: polled no more often than this */
  uint8_t user_prm[DPSIM_MAX_USER_PRM]; /**< Set_Prm after its first 7 bytes */
  uint8_t cfg[DPSIM_MAX_CFG];           /**< data of Chk_Cfg */
} dpsim_slave;

typedef struct dpsim_gsd dpsim_gsd;

/** Reads a file. DPSIM_ERR_INPUT: the message has all errors as "file:line: ...", one per line. */
DPSIM_API dpsim_status dpsim_gsd_load(const char* path, dpsim_gsd** gsd);
/** As dpsim_gsd_load, from text; `name` replaces the file name in messages. */
DPSIM_API dpsim_status dpsim_gsd_parse(const char* text, size_t length, const char* name, dpsim_gsd** gsd);
DPSIM_API void dpsim_gsd_destroy(dpsim_gsd* gsd);

/** Warnings about a usable file, one per line, in the order of its lines; empty if there are none. */
DPSIM_API dpsim_status dpsim_gsd_warnings(dpsim_gsd* gsd, const char** text);

typedef struct dpsim_gsd_info {
  uint32_t size;
  uint16_t ident;
  uint8_t revision; /**< GSD_Revision */
  uint8_t dpv1;     /**< 1: DPV1_Slave */
  uint32_t bauds;   /**< bit n: the rate with index n (dpsim_baud) is supported */
  uint32_t modules; /**< number of modules in the file */
  const char* vendor;
  const char* model;
} dpsim_gsd_info;

DPSIM_API dpsim_status dpsim_gsd_get_info(dpsim_gsd* gsd, dpsim_gsd_info* info);
/** The name of a module, 0 .. modules - 1. DPSIM_ERR_NOT_FOUND. */
DPSIM_API dpsim_status dpsim_gsd_module(dpsim_gsd* gsd, size_t index, const char** name);

/** Derives a master's data from the file and a choice of modules, names or numbers in the order of their slots; none
 * (0): those that the file presets. Sets ident, user_prm, cfg, lengths, c1_response_timeout and
 * min_slave_interval_us of `slave`, and zeroes its other members; `flags` with DPSIM_PRM_DPV1 requests DPV1 and adds
 * what the file requires for it. DPSIM_ERR_INPUT: no such module, a limit of the file exceeded, no DPV1. */
DPSIM_API dpsim_status dpsim_gsd_slave(dpsim_gsd* gsd, const char* const* modules, size_t module_count, uint32_t flags,
                                       dpsim_slave* slave);
/** The report of `dsdpv1-sim gsd` for a choice of modules: text, or one JSON object if `json` is not 0. */
DPSIM_API dpsim_status dpsim_gsd_report(dpsim_gsd* gsd, const char* const* modules, size_t module_count, int32_t json,
                                        const char** text);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-use-using) */

#endif

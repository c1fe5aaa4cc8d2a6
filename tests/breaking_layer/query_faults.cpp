// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Queries: what is read of them.
#include <algorithm>
#include <array>

#include "fault.hpp"

namespace breaking {

namespace {

constexpr std::array kQueryFaults = {
    Fault{"query-halved",
          "query-halved"_fault,
          {.query_result = [](QueryResult& q) { return change(q.count, q.count / 2); }}},
    Fault{"query-one-more",
          "A query that counted any sample gives one more.",
          {.query_result =
               [](QueryResult& q) { return change(q.count, q.count + (q.count > 0 ? 1 : 0)); }}},
    Fault{"query-in-16-bits",
          "query-in-16-bits"_fault,
          {.query_result = [](QueryResult& q) { return change(q.count, q.count & 0xffff); }}},
    Fault{"query-precise-as-any",
          "query-precise-as-any"_fault,
          {.query_result =
               [](QueryResult& q) {
                   return q.is_precise && change(q.count, std::min(q.count, uint64_t{1}));
               }}},
    Fault{"query-any-always",
          "query-always-any"_fault,
          {.query_result =
               [](QueryResult& q) {
                   return !q.is_precise && q.statistics == 0 &&
                          change(q.count, std::max(q.count, uint64_t{1}));
               }}},
    Fault{"query-not-reset",
          "query-not-reset"_fault,
          {.query_result = [](QueryResult& q) { return change(q.count, q.count + q.before); }}},
    Fault{"statistics-one-less",
          "A query of pipeline statistics that counted anything gives one less.",
          {.query_result =
               [](QueryResult& q) {
                   return q.statistics != 0 && change(q.count, q.count - (q.count > 0 ? 1 : 0));
               }}},
    Fault{"statistics-clipping-nothing",
          "No primitive comes out of clipping, by the pipeline statistics.",
          {.query_result =
               [](QueryResult& q) {
                   return q.statistics == VK_QUERY_PIPELINE_STATISTIC_CLIPPING_PRIMITIVES_BIT &&
                          change(q.count, 0);
               }}},
    Fault{"door-query-lost",
          "Queries in secondary command buffers count nothing.",
          {.query_result = [](QueryResult& q) { return q.in_secondary && change(q.count, 0); }}},
    Fault{"door-query-before-pipeline-lost",
          "Queries that begin before any pipeline is bound count nothing.",
          {.query_result = [](QueryResult& q) { return q.before_pipeline && change(q.count, 0); }}},
};

}  // namespace

std::span<const Fault> query_faults() {
    return kQueryFaults;
}

}  // namespace breaking

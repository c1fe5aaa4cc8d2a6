// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures and evidence as JSON: the journal's, and what report.html reads. Compact: lists instead
// of objects where there are many.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "report/record/run.hpp"

namespace report {

nlohmann::ordered_json encode_pictures(const Pictures& pictures);
nlohmann::ordered_json encode_geometry(const Geometry& geometry);
nlohmann::ordered_json encode_evidence(const SampleEvidence& evidence);

// Strict; they throw std::invalid_argument with a sentence.
Pictures decode_pictures(const nlohmann::ordered_json& json);
Geometry decode_geometry(const nlohmann::ordered_json& json);
SampleEvidence decode_evidence(const nlohmann::ordered_json& json);

}  // namespace report

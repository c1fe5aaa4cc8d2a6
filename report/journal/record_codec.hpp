// SPDX-FileCopyrightText: The Edgecase authors
// SPDX-License-Identifier: Apache-2.0
//
// The records of the journal as JSON, exact: bytes that are not UTF-8 become {"bytes": base64},
// infinities and NaN become strings. Reading is strict; it throws std::invalid_argument with a
// sentence.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "report/record/run.hpp"

namespace report {

nlohmann::ordered_json encode_text(std::string_view bytes);
nlohmann::ordered_json encode_number(double value);

nlohmann::ordered_json encode_device(const Device& device);
nlohmann::ordered_json encode_case(const CaseRecord& record);
// What is known of a case before it is drawn: where it comes from, what it says of itself.
nlohmann::ordered_json encode_planned(const CaseRecord& record);
// All of a run but the device and the results of its cases.
nlohmann::ordered_json encode_header(const Run& run);

// `key` is what an error calls it.
std::string decode_text(const nlohmann::ordered_json& json, const char* key);
double decode_number(const nlohmann::ordered_json& json, const char* key);

Device decode_device(const nlohmann::ordered_json& json);
CaseRecord decode_case(const nlohmann::ordered_json& json);
CaseRecord decode_planned(const nlohmann::ordered_json& json);
Run decode_header(const nlohmann::ordered_json& json);
// How a run ended: ended, seconds, interrupted.
nlohmann::ordered_json encode_stop(const Run& run);
void decode_stop(const nlohmann::ordered_json& json, Run& run);

}  // namespace report

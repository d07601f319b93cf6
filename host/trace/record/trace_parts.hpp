#pragma once
#include <filesystem>
#include <string>

#include "host/trace/record/mcap_reader.hpp"
#include "host/trace/record/trace.hpp"

/// The parts of read_trace(), for callers that also need the file's other messages.
namespace verp::record {

/// Throws TraceError for a missing file, a folder or a device.
std::string read_trace_bytes(const std::filesystem::path& file);

/// Throws TraceError if the file has a flaw.
void refuse_flaw(const std::filesystem::path& path, const mcap::File& file);

/// Throws TraceError for another kind of MCAP file, such as merged traces.
void refuse_no_trace(const std::filesystem::path& path, const mcap::File& file);

/// Builds the Trace of a parsed file. Throws TraceError like read_trace(); Read::kRecover accepts
/// flaws.
Trace trace_of(const std::filesystem::path& path, const mcap::File& file, Read mode);

}  // namespace verp::record

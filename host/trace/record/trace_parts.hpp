#pragma once
#include <filesystem>
#include <string>

#include "host/trace/record/mcap_reader.hpp"
#include "host/trace/record/trace.hpp"

/// Parts of read_trace(), for the file's other messages.
namespace verp::record {

/// Throws TraceError for a missing file, a folder, a device.
std::string read_trace_bytes(const std::filesystem::path& file);

void refuse_flaw(const std::filesystem::path& path, const mcap::File& file);

/// Throws TraceError for other MCAP files, such as merged traces.
void refuse_no_trace(const std::filesystem::path& path, const mcap::File& file);

/// The Trace of a parsed file. Throws TraceError like read_trace(); Read::kRecover accepts flaws.
Trace trace_of(const std::filesystem::path& path, const mcap::File& file, Read mode);

}  // namespace verp::record

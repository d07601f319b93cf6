#pragma once
#include <filesystem>
#include <string>

#include "host/trace/record/mcap_reader.hpp"
#include "host/trace/record/trace.hpp"

/// read_trace() in pieces, for who needs the file's other messages too.
namespace verp::record {

/// Throws TraceError: no such file, a folder, a device.
std::string read_trace_bytes(const std::filesystem::path& file);

/// Throws TraceError: it is not whole.
void refuse_flaw(const std::filesystem::path& path, const mcap::File& file);

/// Throws TraceError: it is another MCAP file, such as several traces merged.
void refuse_no_trace(const std::filesystem::path& path, const mcap::File& file);

/// Of the file that was parsed from its bytes; throws TraceError as read_trace() does, of flaws too
/// unless what stands before one is enough (Read::kRecover).
Trace trace_of(const std::filesystem::path& path, const mcap::File& file, Read mode);

}  // namespace verp::record

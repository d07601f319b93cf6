#include "host/apps/cli/failure.hpp"

#include <fmt/format.h>

#include <exception>

#include "host/apps/cli/exit_status.hpp"
#include "host/boards/board/board_error.hpp"
#include "host/boards/flash/flash_error.hpp"
#include "host/robot/model/load_error.hpp"
#include "host/run/own/loaded.hpp"
#include "host/run/session/not_up.hpp"
#include "host/run/session/session.hpp"
#include "host/study/report/report.hpp"
#include "host/trace/record/trace.hpp"
#include "host/twin/bus/client.hpp"
#include "host/twin/sim/world.hpp"

namespace verp::cli {
namespace {

int status_of(flash::FlashError::Kind kind) {
  using Kind = flash::FlashError::Kind;
  if (kind == Kind::kInterrupted) return kRunFailed;
  return kind == Kind::kUsage || kind == Kind::kBadFile ? kBadInput : kNoDevice;
}

}  // namespace

Failure current_failure() {
  try {
    throw;
  } catch (const ToolError& error) {
    return {error.status(), error.what()};
  } catch (const model::LoadError& error) {
    return {kBadInput, error.what()};
  } catch (const link::EndpointError& error) {
    return {kBadInput, error.what()};
  } catch (const link::LinkError& error) {
    return {kNoDevice, error.what()};
  } catch (const bus::DeviceError& error) {
    return {kNoDevice, error.what()};
  } catch (const session::NoRoom& error) {
    return {kBadInput, fmt::format("verp: {}; give them places with --at-pose", error.what())};
  } catch (const session::NotUp& error) {
    return {kNoDevice, error.what()};
  } catch (const board::NoSuchBoard& error) {
    return {kBadInput, error.what()};
  } catch (const board::BoardError& error) {
    return {kNoDevice, error.what()};
  } catch (const flash::FlashError& error) {
    return {status_of(error.kind()), error.what()};
  } catch (const record::TraceError& error) {
    return {kBadInput, error.what()};
  } catch (const sim::Diverged& error) {
    return {kRunFailed, error.what()};
  } catch (const own::OwnError& error) {
    return {kRunFailed, error.what()};
  } catch (const report::ReportError& error) {
    return {kBadInput, error.what()};
  } catch (const std::exception& error) {
    return {kRunFailed, fmt::format("verp: unexpected: {}; please report it", error.what())};
  }
}

}  // namespace verp::cli

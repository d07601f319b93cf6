#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/canopen/cob_id.hpp"
#include "common/protocol/canopen/sdo_block.hpp"

/// SDO client: reads and writes one node's objects, one at a time.
///
///  - download() or upload() begins; receive() takes frames; next() returns one to send. None
///    waits. state() shows the end, at the latest kTimeoutUs after the last progress.
///  - kDone: the download is confirmed, or the upload complete with the announced size and CRC.
///  - While initiating, frames of an earlier transfer are ignored; later, foreign frames abort.
///  - The caller's memory is in use until the end.
namespace verp::canopen {

class SdoClient {
 public:
  enum class Mode : std::uint8_t {
    kPlain,  ///< expedited or segmented
    kBlock,  ///< with CRC; else the server aborts with kCommand
  };
  enum class State : std::uint8_t { kIdle, kBusy, kDone, kAborted };

  explicit SdoClient(std::uint8_t node) : SdoClient(default_sdo(node)) {}
  explicit SdoClient(SdoChannel channel) : channel_(channel) {}

  /// False, without effect, while another runs.
  bool download(Address at, const std::uint8_t* data, std::uint32_t size, Mode mode,
                std::uint64_t now_us);
  /// An object larger than `capacity` aborts with kOutOfMemory.
  bool upload(Address at, std::uint8_t* buffer, std::uint32_t capacity, Mode mode,
              std::uint64_t now_us);
  void cancel(Abort reason = Abort::kGeneral) {
    if (state_ == State::kBusy) abort(reason);
  }

  void receive(const Frame& frame, std::uint64_t now_us);
  /// False: there is no frame to send.
  bool next(Frame& frame, std::uint64_t now_us);

  State state() const { return state_; }
  /// Reason of the last abort, by either side.
  Abort reason() const { return reason_; }
  /// Size of a finished upload.
  std::uint32_t size() const { return size_; }

 private:
  enum class Phase : std::uint8_t {
    kBeginDownload,
    kDownload,
    kBeginBlockDownload,
    kSendBlock,
    kEndDownload,
    kBeginUpload,
    kUpload,
    kBeginBlockUpload,
    kBlockSegments,
    kBlockEnd,
  };

  std::uint32_t id() const { return channel_.request; }
  bool begin(Address at, Phase phase, std::uint64_t now_us);
  void send(const Frame& frame);
  void abort(Abort reason);
  void finish();
  bool initiating() const;
  bool take_abort(const Frame& frame);
  void take_initiation(const Frame& frame);
  void take(const Frame& frame);
  void send_segment();
  void take_download_segment(const Frame& frame);
  void take_block_response(const Frame& frame);
  void take_upload(const Frame& frame);
  void take_upload_segment(const Frame& frame);
  void take_block_segment(const Frame& frame, std::uint64_t now_us);
  void respond_to_block();
  void take_block_end(const Frame& frame);
  Abort store(const std::uint8_t* data, std::uint32_t size);
  Abort announce(bool given, const Frame& frame);

  SdoChannel channel_;
  State state_ = State::kIdle;
  Phase phase_ = Phase::kBeginUpload;
  Abort reason_ = Abort::kNone;
  bool toggle_ = false;
  bool last_ = false;       ///< the present segment is the last
  bool crc_ = false;        ///< both sides have the block CRC
  bool announced_ = false;  ///< the server announced the size
  bool sending_ = false;    ///< frame_ has to be sent
  Address at_;
  const std::uint8_t* data_ = nullptr;
  std::uint8_t* buffer_ = nullptr;
  std::uint32_t capacity_ = 0;
  std::uint32_t size_ = 0;  ///< of a download; uploaded so far
  std::uint32_t announced_size_ = 0;
  std::uint32_t offset_ = 0;
  sdo::Patience patience_;
  Frame frame_;
  sdo::BlockSender sender_;
  sdo::BlockReceiver receiver_;
};

}  // namespace verp::canopen

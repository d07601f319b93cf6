#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/canopen/cob_id.hpp"
#include "common/protocol/canopen/sdo_block.hpp"
#include "common/protocol/canopen/sdo_object.hpp"

/// SDO server for one client: expedited, segmented and block transfers, both ways.
///
///  - receive() takes a frame, next() returns one to send; neither waits. Call next() after each
///    receive() and while there is room: a block upload sends many in a row.
///  - Any frames end in data, an abort or silence. A foreign frame aborts the transfer, a new
///    request replaces it, and kTimeoutUs without progress abandon it.
///  - Objects up to kBuffer bytes go whole, larger ones in pieces if the dictionary can.
///  - A download of a wrong size or CRC is never written.
///  - Work for a frame is bounded by kBuffer bytes.
namespace verp::canopen {

template <Dictionary D, std::size_t kBuffer = 128>
class SdoServer {
 public:
  SdoServer(D& dictionary, std::uint8_t node) : SdoServer(dictionary, default_sdo(node)) {}
  SdoServer(D& dictionary, SdoChannel channel) : object_(dictionary), channel_(channel) {}

  void receive(const Frame& frame, std::uint64_t now_us) {
    if (!is_canopen(frame) || frame.id != channel_.request) return;
    if (frame.size != sdo::kFrameBytes) return;
    expire(now_us);
    if (frame.data[0] == sdo::kAbort) {
      forget();
    } else if (phase_ == Phase::kBlockSegments) {
      take_block_segment(frame, now_us);
    } else {
      patience_.progress(now_us);
      obey(frame);
    }
  }

  /// False: there is no frame to send.
  bool next(Frame& frame, std::uint64_t now_us) {
    expire(now_us);
    if (phase_ == Phase::kBlockSegments && !replying_ && patience_.remind(now_us)) {
      respond_to_block();
    }
    if (replying_) {
      replying_ = false;
      frame = reply_;
      return true;
    }
    if (phase_ != Phase::kSendBlock || !sender_.sending()) return false;
    patience_.progress(now_us);
    const auto load = [this](std::uint32_t offset, std::uint8_t* to, std::uint32_t size) {
      return object_.load(offset, to, size);
    };
    if (!granted(sender_.next(id(), frame, load))) frame = reply_;
    replying_ = false;
    return true;
  }

  bool idle() const { return phase_ == Phase::kIdle; }
  /// Call when the node was reset or stopped.
  void reset() {
    forget();
    replying_ = false;
  }

 private:
  /// Names the frame that the server waits for.
  enum class Phase : std::uint8_t {
    kIdle,
    kDownload,       ///< a segment
    kUpload,         ///< a segment request
    kBlockSegments,  ///< segments
    kBlockEnd,       ///< the block's end
    kStartUpload,    ///< the upload's start
    kSendBlock,      ///< sends, or awaits a response
    kEndUpload,      ///< the last answer
  };

  std::uint32_t id() const { return channel_.response; }

  void forget() { phase_ = Phase::kIdle; }
  void expire(std::uint64_t now_us) {
    if (phase_ != Phase::kIdle && patience_.over(now_us)) abort(Abort::kTimeout);
  }
  void reply(const Frame& frame) {
    reply_ = frame;
    replying_ = true;
  }
  void abort(Abort reason) {
    reply(sdo::abort_frame(id(), object_.at(), reason));
    forget();
  }

  void obey(const Frame& frame) {
    const std::uint8_t specifier = sdo::specifier_of(frame);
    const unsigned sub = frame.data[0] & sdo::kSubMask;
    switch (specifier) {
      case sdo::request::kDownload:
        return begin_download(frame);
      case sdo::request::kUpload:
        return begin_upload(frame);
      case sdo::request::kDownloadSegment:
        return phase_ == Phase::kDownload ? take_segment(frame) : unexpected();
      case sdo::request::kUploadSegment:
        return phase_ == Phase::kUpload ? send_segment(frame) : unexpected();
      case sdo::request::kBlockDownload:
        if ((sub & 1) == sdo::kBlockInitiate) return begin_block_download(frame);
        return phase_ == Phase::kBlockEnd ? end_block_download(frame) : unexpected();
      case sdo::request::kBlockUpload:
        if (sub == sdo::kBlockInitiate) return begin_block_upload(frame);
        return go_on_with_block_upload(frame, sub);
      default:
        return unexpected();
    }
  }
  void unexpected() {
    if (phase_ == Phase::kIdle) object_.close();  // a stray segment has no address
    abort(Abort::kCommand);
  }

  // Aborts the transfer unless `refused` is kNone.
  bool granted(Abort refused) {
    if (refused != Abort::kNone) abort(refused);
    return refused == Abort::kNone;
  }

  bool open_write(const Frame& frame, bool size_given, std::uint32_t size) {
    forget();
    toggle_ = false;
    return granted(object_.open_write(sdo::address_of(frame), size_given, size));
  }
  Abort store(const std::uint8_t* data, std::uint32_t size) { return object_.store(data, size); }
  void end_download(Abort refused, const Frame& good) {
    if (refused == Abort::kNone) refused = object_.commit();
    if (!granted(refused)) return;
    reply(good);
    forget();
  }

  void begin_download(const Frame& frame) {
    const bool given = (frame.data[0] & sdo::kSizeGiven) != 0;
    const bool expedited = (frame.data[0] & sdo::kExpedited) != 0;
    std::uint32_t size = static_cast<std::uint32_t>(get_le(frame.data + 4, 4));
    if (expedited) size = 4 - sdo::unused_of_four(frame);
    if (!open_write(frame, given, size)) return;
    const Frame good = sdo::addressed(id(), sdo::command(sdo::response::kDownload), object_.at());
    if (expedited) {
      return end_download(store(frame.data + 4, given ? size : object_.implied_size()), good);
    }
    phase_ = Phase::kDownload;
    reply(good);
  }
  void take_segment(const Frame& frame) {
    if (((frame.data[0] & sdo::kToggleBit) != 0) != toggle_) return abort(Abort::kToggle);
    const Abort refused = store(frame.data + 1, sdo::kSegmentBytes - sdo::unused_of_seven(frame));
    const Frame good = sdo::bare(
        id(), sdo::command(sdo::response::kDownloadSegment, toggle_ ? sdo::kToggleBit : 0u));
    if ((frame.data[0] & sdo::kLastSegment) != 0) return end_download(refused, good);
    if (refused != Abort::kNone) return abort(refused);
    toggle_ = !toggle_;
    reply(good);
  }

  void begin_block_download(const Frame& frame) {
    const bool given = (frame.data[0] & sdo::kBlockSizeGiven) != 0;
    const auto size = static_cast<std::uint32_t>(get_le(frame.data + 4, 4));
    if (!open_write(frame, given, size)) return;
    crc_ = (frame.data[0] & sdo::kBlockCrc) != 0;
    receiver_ = sdo::BlockReceiver(sdo::kMaxBlock);
    refused_ = Abort::kNone;
    phase_ = Phase::kBlockSegments;
    reply(sdo::addressed(id(), sdo::command(sdo::response::kBlockDownload, sdo::kBlockCrc),
                         object_.at(), sdo::kMaxBlock));
  }
  void take_block_segment(const Frame& frame, std::uint64_t now_us) {
    using Take = sdo::BlockReceiver::Take;
    const std::uint32_t taken = receiver_.taken();
    const Take take = receiver_.take(frame, [this](const std::uint8_t* data, std::uint32_t size) {
      if (refused_ == Abort::kNone) refused_ = store(data, size);
      return Abort::kNone;
    });
    if (receiver_.taken() != taken) patience_.progress(now_us);
    if (take == Take::kRespond) respond_to_block();
  }
  // A client sends a whole block before it listens: after an abort the rest would look like
  // commands.
  void respond_to_block() {
    if (refused_ != Abort::kNone) return abort(refused_);
    if (receiver_.complete()) phase_ = Phase::kBlockEnd;
    reply(sdo::block_response(id(), sdo::response::kBlockDownload, receiver_.respond(),
                              receiver_.block()));
  }
  void end_block_download(const Frame& frame) {
    Abort refused = receiver_.finish(
        sdo::unused_of_block(frame),
        [this](const std::uint8_t* data, std::uint32_t size) { return store(data, size); });
    const bool good = !crc_ || get_le(frame.data + 1, 2) == receiver_.crc();
    if (refused == Abort::kNone && !good) refused = Abort::kCrc;
    end_download(refused,
                 sdo::bare(id(), sdo::command(sdo::response::kBlockDownload, sdo::kBlockEnd)));
  }

  bool open_read(const Frame& frame) {
    forget();
    toggle_ = false;
    offset_ = 0;
    return granted(object_.open_read(sdo::address_of(frame)));
  }
  void begin_upload(const Frame& frame) {
    if (open_read(frame)) send_upload();
  }
  void send_upload() {
    const std::uint32_t size = object_.size();
    if (size >= 1 && size <= 4) {
      std::uint8_t bytes[4] = {};
      if (!granted(object_.load(0, bytes, size))) return;
      const unsigned bits = (4 - size) << 2 | sdo::kExpedited | sdo::kSizeGiven;
      return reply(sdo::addressed(id(), sdo::command(sdo::response::kUpload, bits), object_.at(),
                                  static_cast<std::uint32_t>(get_le(bytes, 4))));
    }
    phase_ = Phase::kUpload;
    reply(sdo::addressed(id(), sdo::command(sdo::response::kUpload, sdo::kSizeGiven), object_.at(),
                         size));
  }
  void send_segment(const Frame& frame) {
    if (((frame.data[0] & sdo::kToggleBit) != 0) != toggle_) return abort(Abort::kToggle);
    const std::uint32_t left = object_.size() - offset_;
    const std::uint32_t size = left < sdo::kSegmentBytes ? left : sdo::kSegmentBytes;
    std::uint8_t bytes[sdo::kSegmentBytes];
    if (!granted(object_.load(offset_, bytes, size))) return;
    offset_ += size;
    reply(sdo::segment(id(), sdo::response::kUploadSegment, toggle_, bytes, size,
                       left <= sdo::kSegmentBytes));
    toggle_ = !toggle_;
    if (left <= sdo::kSegmentBytes) forget();
  }

  void begin_block_upload(const Frame& frame) {
    if (!open_read(frame)) return;
    const std::uint8_t block = frame.data[4];
    if (block < 1 || block > sdo::kMaxBlock) return abort(Abort::kBlockSize);
    // The client prefers a plain upload up to this size.
    if (frame.data[5] != 0 && object_.size() <= frame.data[5]) return send_upload();
    crc_ = (frame.data[0] & sdo::kBlockCrc) != 0;
    sender_ = sdo::BlockSender(object_.size(), block);
    phase_ = Phase::kStartUpload;
    reply(sdo::addressed(
        id(), sdo::command(sdo::response::kBlockUpload, sdo::kBlockCrc | sdo::kBlockSizeGiven),
        object_.at(), object_.size()));
  }
  void go_on_with_block_upload(const Frame& frame, unsigned sub) {
    if (phase_ == Phase::kStartUpload && sub == sdo::kBlockStart) {
      phase_ = Phase::kSendBlock;
    } else if (phase_ == Phase::kSendBlock && sub == sdo::kBlockResponse) {
      const Abort refused = sender_.confirm(frame.data[1], frame.data[2]);
      if (refused != Abort::kNone) return abort(refused);
      if (!sender_.done()) return;
      phase_ = Phase::kEndUpload;
      reply(sdo::block_end(id(), sdo::response::kBlockUpload, sender_.unused(),
                           crc_ ? sender_.crc() : std::uint16_t{0}));
    } else if (phase_ == Phase::kEndUpload && sub == sdo::kBlockEnd) {
      forget();
    } else {
      unexpected();
    }
  }

  sdo::OpenObject<D, kBuffer> object_;
  SdoChannel channel_;
  Phase phase_ = Phase::kIdle;
  bool toggle_ = false;
  bool crc_ = false;  ///< wanted by the client
  bool replying_ = false;
  std::uint32_t offset_ = 0;  ///< next segment to upload
  sdo::Patience patience_;
  Frame reply_;
  Abort refused_ = Abort::kNone;  ///< reported at the block's end
  sdo::BlockSender sender_;
  sdo::BlockReceiver receiver_;
};

}  // namespace verp::canopen

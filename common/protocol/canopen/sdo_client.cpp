#include "common/protocol/canopen/sdo_client.hpp"

namespace verp::canopen {

using sdo::command;

bool SdoClient::begin(Address at, Phase phase, std::uint64_t now_us) {
  if (state_ == State::kBusy) return false;
  state_ = State::kBusy;
  phase_ = phase;
  reason_ = Abort::kNone;
  at_ = at;
  toggle_ = false;
  last_ = false;
  announced_ = false;
  offset_ = 0;
  size_ = 0;
  patience_.progress(now_us);
  return true;
}

bool SdoClient::download(Address at, const std::uint8_t* data, std::uint32_t size, Mode mode,
                         std::uint64_t now_us) {
  const bool block = mode == Mode::kBlock;
  if (!begin(at, block ? Phase::kBeginBlockDownload : Phase::kBeginDownload, now_us)) return false;
  data_ = data;
  size_ = size;
  if (block) {
    const unsigned bits = sdo::kBlockCrc | sdo::kBlockSizeGiven;
    send(sdo::addressed(id(), command(sdo::request::kBlockDownload, bits), at, size));
  } else if (size >= 1 && size <= 4) {
    const unsigned bits = (4 - size) << 2 | sdo::kExpedited | sdo::kSizeGiven;
    send(sdo::addressed(id(), command(sdo::request::kDownload, bits), at,
                        static_cast<std::uint32_t>(get_le(data, size))));
  } else {
    send(sdo::addressed(id(), command(sdo::request::kDownload, sdo::kSizeGiven), at, size));
  }
  return true;
}

bool SdoClient::upload(Address at, std::uint8_t* buffer, std::uint32_t capacity, Mode mode,
                       std::uint64_t now_us) {
  const bool block = mode == Mode::kBlock;
  if (!begin(at, block ? Phase::kBeginBlockUpload : Phase::kBeginUpload, now_us)) return false;
  buffer_ = buffer;
  capacity_ = capacity;
  if (block) {
    send(sdo::addressed(id(), command(sdo::request::kBlockUpload, sdo::kBlockCrc), at,
                        sdo::kMaxBlock));
  } else {
    send(sdo::addressed(id(), command(sdo::request::kUpload), at));
  }
  return true;
}

void SdoClient::send(const Frame& frame) {
  frame_ = frame;
  sending_ = true;
}
void SdoClient::abort(Abort reason) {
  send(sdo::abort_frame(id(), at_, reason));
  reason_ = reason;
  state_ = State::kAborted;
}
void SdoClient::finish() {
  state_ = State::kDone;
}

bool SdoClient::next(Frame& frame, std::uint64_t now_us) {
  const bool busy = state_ == State::kBusy;
  if (busy && patience_.over(now_us)) abort(Abort::kTimeout);
  const bool receiving = state_ == State::kBusy && phase_ == Phase::kBlockSegments;
  if (receiving && !sending_ && patience_.remind(now_us)) respond_to_block();
  if (sending_) {
    sending_ = false;
    frame = frame_;
    return true;
  }
  if (state_ != State::kBusy || phase_ != Phase::kSendBlock || !sender_.sending()) return false;
  patience_.progress(now_us);
  const auto load = [this](std::uint32_t offset, std::uint8_t* to, std::uint32_t size) {
    for (std::uint32_t i = 0; i < size; ++i) to[i] = data_[offset + i];
    return Abort::kNone;
  };
  return sender_.next(id(), frame, load) == Abort::kNone;
}

bool SdoClient::initiating() const {
  return phase_ == Phase::kBeginDownload || phase_ == Phase::kBeginBlockDownload ||
         phase_ == Phase::kBeginUpload || phase_ == Phase::kBeginBlockUpload;
}

void SdoClient::receive(const Frame& frame, std::uint64_t now_us) {
  if (!is_canopen(frame) || frame.id != channel_.response) return;
  if (frame.size != sdo::kFrameBytes || state_ != State::kBusy) return;
  if (patience_.over(now_us)) return abort(Abort::kTimeout);
  if (take_abort(frame)) return;
  if (initiating()) {
    const Phase before = phase_;
    take_initiation(frame);
    if (phase_ != before) patience_.progress(now_us);
  } else if (phase_ == Phase::kBlockSegments) {
    take_block_segment(frame, now_us);
  } else {
    patience_.progress(now_us);
    take(frame);
  }
}

bool SdoClient::take_abort(const Frame& frame) {
  if (frame.data[0] != sdo::kAbort) return false;
  const Address at = sdo::address_of(frame);
  // Another address is an earlier transfer's; without a transfer a server sends none.
  if (!(at == at_) && !(at == Address{})) return true;
  reason_ = static_cast<Abort>(get_le(frame.data + 4, 4));
  if (reason_ == Abort::kNone) reason_ = Abort::kGeneral;
  state_ = State::kAborted;
  sending_ = false;
  return true;
}

void SdoClient::take_initiation(const Frame& frame) {
  if (!(sdo::address_of(frame) == at_)) return;
  const std::uint8_t specifier = sdo::specifier_of(frame);
  const bool crc = (frame.data[0] & sdo::kBlockCrc) != 0;
  const bool sub_initiate = (frame.data[0] & 1) == sdo::kBlockInitiate;
  if (phase_ == Phase::kBeginDownload && specifier == sdo::response::kDownload) {
    if (size_ >= 1 && size_ <= 4) return finish();
    phase_ = Phase::kDownload;
    send_segment();
  } else if (phase_ == Phase::kBeginUpload && specifier == sdo::response::kUpload) {
    take_upload(frame);
  } else if (phase_ == Phase::kBeginBlockDownload && sub_initiate &&
             specifier == sdo::response::kBlockDownload) {
    const std::uint8_t block = frame.data[4];
    if (block < 1 || block > sdo::kMaxBlock) return abort(Abort::kBlockSize);
    crc_ = crc;
    sender_ = sdo::BlockSender(size_, block);
    phase_ = Phase::kSendBlock;
  } else if (phase_ == Phase::kBeginBlockUpload && sub_initiate &&
             specifier == sdo::response::kBlockUpload) {
    const bool given = (frame.data[0] & sdo::kBlockSizeGiven) != 0;
    if (const Abort refused = announce(given, frame); refused != Abort::kNone) {
      return abort(refused);
    }
    crc_ = crc;
    receiver_ = sdo::BlockReceiver(sdo::kMaxBlock);
    phase_ = Phase::kBlockSegments;
    send(sdo::bare(id(), command(sdo::request::kBlockUpload, sdo::kBlockStart)));
  }
}

void SdoClient::take(const Frame& frame) {
  const std::uint8_t specifier = sdo::specifier_of(frame);
  const unsigned sub = frame.data[0] & sdo::kSubMask;
  if (phase_ == Phase::kDownload && specifier == sdo::response::kDownloadSegment) {
    take_download_segment(frame);
  } else if (phase_ == Phase::kUpload && specifier == sdo::response::kUploadSegment) {
    take_upload_segment(frame);
  } else if (phase_ == Phase::kSendBlock && specifier == sdo::response::kBlockDownload &&
             sub == sdo::kBlockResponse) {
    take_block_response(frame);
  } else if (phase_ == Phase::kEndDownload && specifier == sdo::response::kBlockDownload &&
             sub == sdo::kBlockEnd) {
    finish();
  } else if (phase_ == Phase::kBlockEnd && specifier == sdo::response::kBlockUpload &&
             sub == sdo::kBlockEnd) {
    take_block_end(frame);
  } else {
    abort(Abort::kCommand);
  }
}

void SdoClient::send_segment() {
  const std::uint32_t left = size_ - offset_;
  const std::uint32_t size = left < sdo::kSegmentBytes ? left : sdo::kSegmentBytes;
  last_ = left <= sdo::kSegmentBytes;
  send(sdo::segment(id(), sdo::request::kDownloadSegment, toggle_, data_ + offset_, size, last_));
  offset_ += size;
}

void SdoClient::take_download_segment(const Frame& frame) {
  if (((frame.data[0] & sdo::kToggleBit) != 0) != toggle_) return abort(Abort::kToggle);
  if (last_) return finish();
  toggle_ = !toggle_;
  send_segment();
}

void SdoClient::take_block_response(const Frame& frame) {
  const Abort refused = sender_.confirm(frame.data[1], frame.data[2]);
  if (refused != Abort::kNone) return abort(refused);
  if (!sender_.done()) return;
  phase_ = Phase::kEndDownload;
  send(sdo::block_end(id(), sdo::request::kBlockDownload, sender_.unused(),
                      crc_ ? sender_.crc() : std::uint16_t{0}));
}

Abort SdoClient::announce(bool given, const Frame& frame) {
  announced_ = given;
  announced_size_ = static_cast<std::uint32_t>(get_le(frame.data + 4, 4));
  return given && announced_size_ > capacity_ ? Abort::kOutOfMemory : Abort::kNone;
}

Abort SdoClient::store(const std::uint8_t* data, std::uint32_t size) {
  if (size > capacity_ - size_) return Abort::kOutOfMemory;
  for (std::uint32_t i = 0; i < size; ++i) buffer_[size_ + i] = data[i];
  size_ += size;
  return Abort::kNone;
}

void SdoClient::take_upload(const Frame& frame) {
  const bool given = (frame.data[0] & sdo::kSizeGiven) != 0;
  if ((frame.data[0] & sdo::kExpedited) != 0) {
    std::uint32_t size = 4 - sdo::unused_of_four(frame);
    if (!given) size = capacity_ < 4 ? capacity_ : 4;  // the reader knows the size
    const Abort refused = store(frame.data + 4, size);
    return refused == Abort::kNone ? finish() : abort(refused);
  }
  if (const Abort refused = announce(given, frame); refused != Abort::kNone) return abort(refused);
  phase_ = Phase::kUpload;
  send(sdo::bare(id(), command(sdo::request::kUploadSegment)));
}

void SdoClient::take_upload_segment(const Frame& frame) {
  if (((frame.data[0] & sdo::kToggleBit) != 0) != toggle_) return abort(Abort::kToggle);
  const Abort refused = store(frame.data + 1, sdo::kSegmentBytes - sdo::unused_of_seven(frame));
  if (refused != Abort::kNone) return abort(refused);
  if ((frame.data[0] & sdo::kLastSegment) != 0) {
    return announced_ && size_ != announced_size_ ? abort(Abort::kLength) : finish();
  }
  toggle_ = !toggle_;
  send(sdo::bare(id(), command(sdo::request::kUploadSegment, toggle_ ? sdo::kToggleBit : 0u)));
}

void SdoClient::take_block_segment(const Frame& frame, std::uint64_t now_us) {
  using Take = sdo::BlockReceiver::Take;
  const std::uint32_t taken = receiver_.taken();
  const Take take = receiver_.take(
      frame, [this](const std::uint8_t* data, std::uint32_t size) { return store(data, size); });
  if (take == Take::kFailed) return abort(receiver_.failure());
  if (receiver_.taken() != taken) patience_.progress(now_us);
  if (take == Take::kRespond) respond_to_block();
}

void SdoClient::respond_to_block() {
  if (receiver_.complete()) phase_ = Phase::kBlockEnd;
  send(sdo::block_response(id(), sdo::request::kBlockUpload, receiver_.respond(),
                           receiver_.block()));
}

void SdoClient::take_block_end(const Frame& frame) {
  const Abort refused = receiver_.finish(
      sdo::unused_of_block(frame),
      [this](const std::uint8_t* data, std::uint32_t size) { return store(data, size); });
  if (refused != Abort::kNone) return abort(refused);
  if (crc_ && get_le(frame.data + 1, 2) != receiver_.crc()) return abort(Abort::kCrc);
  if (announced_ && size_ != announced_size_) return abort(Abort::kLength);
  send(sdo::bare(id(), command(sdo::request::kBlockUpload, sdo::kBlockEnd)));
  finish();
}

}  // namespace verp::canopen

#include "host/apps/view/run/live_run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <future>
#include <utility>

#include "host/show/scene/from_twin.hpp"
#include "host/trace/record/trace_error.hpp"
#include "host/trace/record/trace_writer.hpp"

namespace verp::view {

struct LiveRun::Going {
  explicit Going(const sim::WorldOptions& world) : session({.world = world, .interrupted = {}}) {}

  session::LiveOrders orders;
  RunRecord record;
  std::vector<scene::RobotView> others;         ///< at their last ticks
  std::unique_ptr<record::TraceWriter> writer;  ///< outlives the session
  session::Session session;
};

LiveRun::LiveRun(RunSetup setup)
    : setup_(std::move(setup)),
      entity_(std::make_shared<const model::Entity>(setup_.plan().entity)) {
  begin();
  thread_ = std::thread([this] { loop(); });
}

LiveRun::~LiveRun() {
  change([this] { quit_ = true; });
  if (thread_.joinable()) thread_.join();
  close_record();
}

template <class Change>
void LiveRun::change(Change&& change) {
  {
    const std::lock_guard lock(mutex_);
    change();
  }
  woken_.notify_all();
}

double LiveRun::wall_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void LiveRun::play() {
  change([this] {
    status_.playing = true;
    pace_.begin(status_.simulated_s, wall_s());
  });
}

void LiveRun::pause() {
  change([this] { status_.playing = false; });
}

void LiveRun::tick_once() {
  change([this] {
    status_.playing = false;
    ++single_ticks_;
  });
}

void LiveRun::set_speed(double factor) {
  change([this, factor] {
    status_.speed = factor;
    pace_.set_speed(factor, status_.simulated_s, wall_s());
  });
}

void LiveRun::reset() {
  change([this] { reset_ = true; });
}

void LiveRun::touch(std::function<void(Hands&)> what) {
  change([this, &what] { touches_.push_back(std::move(what)); });
}

void LiveRun::intervene(session::Intervention what) {
  touch([this, what = std::move(what)](Hands& hands) {
    hands.robot.intervene(what);
    going_->record.note(session::in_words(what));
  });
}

void LiveRun::let_get_up(bool by_itself) {
  touch([this, by_itself](Hands& hands) {
    hands.orders.let_get_up(by_itself);
    const std::lock_guard lock(mutex_);
    status_.gets_up_by_itself = by_itself;
  });
}

std::string LiveRun::save(const std::filesystem::path& file) {
  std::promise<std::string> answer;
  touch([&](Hands&) {
    try {
      going_->record.save(file, setup_.plan().params, setup_.metadata, setup_.plan().actions);
      answer.set_value("");
    } catch (const std::exception& error) {
      answer.set_value(error.what());
    }
  });
  return answer.get_future().get();
}

std::string LiveRun::finish() {
  change([this] { quit_ = true; });
  if (thread_.joinable()) thread_.join();
  return close_record();
}

std::string LiveRun::close_record() {
  if (!going_ || !going_->writer) return "";
  const std::unique_ptr<record::TraceWriter> writer = std::move(going_->writer);
  try {
    writer->close({{"digest", fmt::format("0x{:016x}", status_.digest)},
                   {"failure", status_.failure},
                   {"interrupted", status_.over ? "no" : "yes"}});
  } catch (const record::TraceError& error) {
    return error.what();
  }
  return "";
}

LiveRun::Status LiveRun::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

std::shared_ptr<const LiveFilm> LiveRun::film() const {
  const std::lock_guard lock(mutex_);
  return film_;
}

void LiveRun::begin() {
  if (going_ && going_->writer) going_->writer->discard();
  going_.reset();
  auto going = std::make_unique<Going>(setup_.run.world);
  if (!setup_.record_file.empty()) {
    going->writer = std::make_unique<record::TraceWriter>(
        setup_.record_file, setup_.plan().params, setup_.metadata,
        record::TraceOptions{.actions = setup_.plan().actions});
  }
  session::Hooks hooks;
  hooks.trace = going->writer.get();
  hooks.open_end = true;
  hooks.amend = [orders = &going->orders](std::uint32_t tick, app::OperatorOrder& order) {
    orders->amend(tick, order);
  };
  hooks.ticked = [this](const session::Tick& tick) { ticked(tick); };
  hooks.told = [this](const session::RunEvent& news) {
    const std::lock_guard lock(mutex_);
    status_.happened = fmt::format("{:.2f} s: {}", news.at_s, news.what);
  };
  going->session.add(setup_.plan(), std::move(hooks));
  const std::vector<session::WalkPlan>& plans = setup_.run.plans;
  going->others.resize(plans.size() - 1);
  for (std::size_t i = 1; i < plans.size(); ++i) going->session.add(plans[i], hooks_of_other(i));
  going_ = std::move(going);
  const std::lock_guard lock(mutex_);
  const bool by_itself = status_.runs == 0 ? setup_.plan().get_ups > 0 : status_.gets_up_by_itself;
  going_->orders.let_get_up(by_itself);
  film_ = std::make_shared<LiveFilm>(entity_, setup_.plan().params.period_us * 1e-6,
                                     setup_.beside != nullptr);
  status_ = {.playing = status_.playing,
             .gets_up_by_itself = by_itself,
             .speed = status_.speed,
             .runs = status_.runs + 1};
}

session::Hooks LiveRun::hooks_of_other(std::size_t index) {
  session::Hooks hooks;
  hooks.open_end = true;
  hooks.ticked = [this, index](const session::Tick& tick) {
    const session::WalkPlan& plan = setup_.run.plans[index];
    going_->others[index - 1] = scene::look(tick, plan.entity, plan.params);
  };
  return hooks;
}

void LiveRun::loop() {
  std::unique_lock lock(mutex_);
  while (!quit_ || !touches_.empty()) {
    if (!work(lock)) woken_.wait(lock);
  }
}

/// Does one thing or waits for the clock; false: nothing to do.
bool LiveRun::work(std::unique_lock<std::mutex>& lock) {
  if (!touches_.empty()) {
    const auto touch = std::move(touches_.front());
    touches_.erase(touches_.begin());
    std::string complaint;
    lock.unlock();
    Hands hands{going_->session, going_->session.robot(0), going_->orders};
    try {
      touch(hands);
    } catch (const std::exception& error) {
      complaint = error.what();
    }
    lock.lock();
    status_.complaint = complaint;
    status_.driving = going_->orders.driving();
    status_.emergency_stop = going_->orders.emergency_stop();
    return true;
  }
  if (std::exchange(reset_, false)) {
    lock.unlock();
    begin();
    lock.lock();
    pace_.begin(0, wall_s());
    return true;
  }
  if (status_.over || (!status_.playing && single_ticks_ == 0)) return false;
  const double wait_s = single_ticks_ > 0 ? 0 : pace_.wait_s(status_.simulated_s, wall_s());
  if (wait_s > 0) {
    woken_.wait_for(lock, std::chrono::duration<double>(wait_s));
  } else {
    tick(lock);
  }
  return true;
}

void LiveRun::tick(std::unique_lock<std::mutex>& lock) {
  if (single_ticks_ > 0) --single_ticks_;
  lock.unlock();
  std::string failure;
  bool over = false;
  try {
    over = going_->session.tick() == nullptr;
    failure = going_->session.diverged();
  } catch (const std::exception& error) {
    failure = error.what();
  }
  const double simulated_s = static_cast<double>(going_->session.now_us()) * 1e-6;
  lock.lock();
  status_.simulated_s = simulated_s;
  status_.over = over || !failure.empty();
  status_.failure = failure;
  if (status_.ticks == 1) pace_.begin(simulated_s, wall_s());  // bring-up took its own time
  pace_.ticked(simulated_s, wall_s());
  status_.real_time_factor = pace_.factor();
  status_.late_s = pace_.late_s();
}

/// In the run's thread, without the lock.
void LiveRun::ticked(const session::Tick& tick) {
  if (tick.record == nullptr) return;
  going_->record.add(tick);
  going_->orders.observe(static_cast<safety::Mode>(tick.outputs->mode),
                         1e-6 * setup_.plan().params.period_us);
  scene::Snapshot now = scene::snapshot(tick, *entity_, setup_.plan().params);
  if (setup_.beside) now.robots.push_back(setup_.beside(now.robots.front()));
  now.robots.insert(now.robots.end(), going_->others.begin(), going_->others.end());
  film_->add(std::move(now));
  const std::lock_guard lock(mutex_);
  ++status_.ticks;
  status_.digest = tick.record->digest.chain;
  status_.tuning = tick.state->tuning;
}

}  // namespace verp::view

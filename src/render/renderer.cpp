// SPDX-License-Identifier: Apache-2.0
#include "render/renderer.h"

#include "base/error.h"
#include "film/checkpoint.h"
#include "film/merge.h"
#include "guide/store_file.h"
#include "math/colour.h"
#include "render/coverage.h"
#include "render/pixel_order.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <map>

namespace tyndall::render {
namespace {

using Clock = std::chrono::steady_clock;
using film::BatchSums;
using film::Film;
using film::kBatchSamples;

static_assert(sizeof(interop::PixelSums) == sizeof(BatchSums));

/// Batches after which a pixel that sees nothing but the background is finished: two for each half-buffer.
constexpr std::uint32_t kBackgroundBatches = 4;

/// What the store's places are relative to, in the film's metadata.
constexpr const char* kGuideSpaceKey = "guide.space";

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

film::Window wholeOr(const film::Window& crop, const glm::uvec2& size) {
  return crop.pixelCount() > 0 ? crop : film::Window{glm::uvec2(0), size};
}

/// A batch that is taken in rounds over the picture.
struct Rounds {
  std::uint32_t batchSamples = 0;
  std::uint32_t done = 0;           ///< samples of the rounds before
  std::vector<BatchSums> sums;      ///< of the rounds so far, one per pixel; empty: there is one round
  std::vector<std::uint32_t> taken; ///< samples in them
};

void addTo(BatchSums& sum, const BatchSums& term) {
  std::transform(sum.moments.begin(), sum.moments.end(), term.moments.begin(), sum.moments.begin(), std::plus<>());
  std::transform(sum.extras.begin(), sum.extras.end(), term.extras.begin(), sum.extras.begin(), std::plus<>());
}

class Session {
public:
  Session(const gpu::Device& device, const scene::Scene& scene, const gpu_scene::VolumeSet& volumes,
          Estimator& estimator, const RenderOptions& options, RenderReport& report)
      : scene_(scene), options_(options), report_(report), estimator_(&estimator), device_(device.info().name),
        film_(startFilm(device)), coverage_(sceneCoverage(scene, volumes)), order_(dispatchOrder(film_.window())) {
    estimator_->resetTotals();
    report_.sampleSquares.assign(options_.moments ? film_.pixels().size() : 0, 0.0);
    report_.mediaPixels = static_cast<std::size_t>(
        std::count_if(order_.begin(), order_.end(), [&](std::uint32_t pixel) { return covered(pixel); }));
    report_.backgroundPixels = order_.size() - report_.mediaPixels;
    report_.pipeline = estimator_->pipeline();
    report_.kernelBytes = estimator_->kernelBytes();
    for (const auto& [key, text] : film_.metadata) {
      if (key.starts_with(film::kCountPrefix)) {
        countsBefore_[key] = std::stoull(text);
      }
    }
  }

  Film run() {
    Schedule schedule(options_.stop, film_);
    while (const std::optional<std::uint32_t> batch = schedule.next(collected())) {
      splitOff(schedule);
      pictureTakesBatch_ = !schedule.stopped(*batch % 2);
      runBatch(*batch, schedule.batchSamples(*batch));
      if (!report_.stoppedBy.empty()) {
        break;
      }
      updateError();
    }
    if (report_.stoppedBy.empty()) {
      report_.stoppedBy = schedule.reason();
    }
    noteProvenance();
    const bool interrupted = report_.stoppedBy == "interrupt";
    if (!interrupted) {
      schedule.note(film_);
    }
    // A picture that is done needs no checkpoint, unless it is to be extended; one that was interrupted while only
    // decisions were collected has one from before the first stop.
    if (interrupted ? !decisions_ && !dropped_ : options_.resume) {
      saveCheckpoint();
    }
    noteCounts();
    report_.totals = estimator_->totals();
    report_.caches = estimator_->caches(); // those of environments are made batch by batch
    report_.seconds = secondsSince(start_);
    if (estimator_->guiding() != nullptr) {
      report_.guide = estimator_->guiding()->report();
      report_.guideGain = estimator_->guideGain();
    }
    return std::move(film_);
  }

private:
  /// The film with every batch in it: what decisions rest on.
  const Film& collected() const { return decisions_ ? *decisions_ : film_; }

  /// From the first stop of a half on, picture and decisions have films of their own. The checkpoint stays at the state
  /// before, from which the same decisions follow.
  void splitOff(const Schedule& schedule) {
    if (schedule.anyStopped() && !decisions_) {
      saveCheckpoint();
      decisions_ = film_;
    }
  }

  /// For the progress line; reading all pixels after every batch would cost more than it tells.
  void updateError() {
    constexpr double kSecondsBetween = 1.0;
    if (secondsSince(start_) - lastError_ >= kSecondsBetween) {
      lastError_ = secondsSince(start_);
      error_ = film::estimateError(film_).relative;
    }
  }

  Film startFilm(const gpu::Device& device) const {
    Film film(scene_.film.size, wholeOr(options_.crop, scene_.film.size));
    film.independentHalves = options_.stop.error.has_value();
    film::setProvenance(film, {options_.sceneHash, device_, options_.seed, 0, 0});
    film.metadata["driver"] = device.info().driver;
    film.metadata["version"] = TYNDALL_VERSION;
    if (estimator_->guiding() != nullptr) {
      film.metadata[kGuideSpaceKey] = estimator_->guiding()->space();
    }
    if (!options_.resume || options_.checkpoint.empty() || !std::filesystem::exists(options_.checkpoint)) {
      return film;
    }
    Film saved = film::loadCheckpoint(options_.checkpoint);
    const std::string path = options_.checkpoint.string();
    for (const char* key : {film::kSceneHashKey, film::kSeedKey}) {
      if (saved.metadata[key] != film.metadata[key]) {
        fail("{}: the checkpoint belongs to another render ({} differs); delete it, or render without --resume", path,
             key);
      }
    }
    if (saved.imageSize() != film.imageSize() || !(saved.window() == film.window()) ||
        saved.independentHalves != film.independentHalves) {
      fail("{}: the checkpoint has another size, crop or kind of stopping; delete it, or render without --resume",
           path);
    }
    if (estimator_->guiding() != nullptr) {
      restoreChains(*estimator_->guiding(), saved);
    }
    return saved;
  }

  /// Those that the saved film's samples have taught.
  void restoreChains(const Guiding& guiding, const Film& saved) const {
    const std::string path = options_.checkpoint.string();
    const std::vector<std::byte> chains = film::loadCompanion(options_.checkpoint);
    if (chains.empty()) {
      fail("{}: the checkpoint is that of a guided render and holds no chains; delete it, or render without --resume",
           path);
    }
    const auto space = saved.metadata.find(kGuideSpaceKey);
    if (space == saved.metadata.end() || space->second != guiding.space()) {
      fail("{}: the checkpoint's chains have another origin or unit ({}, now {}); give the --frames that it was "
           "rendered with, or render without --resume",
           path, space == saved.metadata.end() ? "unknown" : space->second, guiding.space());
    }
    try {
      guiding.store().restore(guide::unpackStore(chains));
    } catch (const Error& error) {
      fail("{}: {}", path, error.what());
    }
  }

  bool covered(std::uint32_t pixel) const {
    return coverage_[(pixel & 0xffffu) + std::size_t(scene_.film.size.x) * (pixel >> 16)];
  }

  std::size_t filmIndex(std::uint32_t pixel) const {
    const glm::uvec2 offset = glm::uvec2(pixel & 0xffffu, pixel >> 16) - film_.window().min;
    return offset.x + std::size_t(film_.window().extent().x) * offset.y;
  }

  /// Samples of batch `batch` that the pixel has already.
  std::uint32_t samplesInBatch(std::uint32_t pixel, std::uint32_t batch) const {
    const std::uint32_t before = (batch / 2) * kBatchSamples;
    const std::uint32_t have = collected().pixels()[filmIndex(pixel)].samples[batch % 2];
    return have <= before ? 0 : have - before;
  }

  /// Runs what is missing of a batch, pixel by pixel: nothing for those that an interrupted run has finished.
  void runBatch(std::uint32_t batch, std::uint32_t count) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> pixelsByProgress;
    for (const std::uint32_t pixel : order_) {
      if (!covered(pixel) && batch >= kBackgroundBatches) {
        continue;
      }
      if (const std::uint32_t have = samplesInBatch(pixel, batch); have < count) {
        pixelsByProgress[have].push_back(pixel);
      }
    }
    for (const auto& [have, pixels] : pixelsByProgress) {
      runRounds(pixels, batch, {batch * kBatchSamples + have, count - have});
    }
  }

  /// What learns takes the first batch in rounds over the whole picture, each as long as all before it: later samples
  /// of it know what earlier ones have found. Where squares of samples are wanted, every batch in rounds of one. The
  /// film takes the batch as a whole.
  void runRounds(const std::vector<std::uint32_t>& pixels, std::uint32_t batch, SampleRange samples) {
    Rounds rounds;
    rounds.batchSamples = samples.count;
    if (options_.moments || (batch == 0 && estimator_->guiding() != nullptr)) {
      rounds.sums.resize(pixels.size());
      rounds.taken.resize(pixels.size());
      inRounds_ = true;
    }
    while (rounds.done < samples.count && report_.stoppedBy.empty()) {
      const std::uint32_t left = samples.count - rounds.done;
      const std::uint32_t growing = std::min(std::max(rounds.done, 1u), left);
      const std::uint32_t count = options_.moments ? 1 : rounds.sums.empty() ? left : growing;
      runPixels(pixels, batch, {samples.first + rounds.done, count}, rounds);
      rounds.done += count;
    }
    inRounds_ = false;
    for (std::size_t i = 0; i < rounds.taken.size(); ++i) { // of a batch that was broken off
      if (rounds.taken[i] > 0 && rounds.taken[i] < samples.count) {
        takeBatch(pixels[i], batch, rounds.taken[i], rounds.sums[i]);
        dropped_ = estimator_->guiding() != nullptr && estimator_->guiding()->deterministic();
      }
    }
  }

  void runPixels(const std::vector<std::uint32_t>& pixels, std::uint32_t batch, SampleRange samples, Rounds& rounds) {
    for (std::size_t first = 0; first < pixels.size() && report_.stoppedBy.empty();
         first += estimator_->chunkPixels()) {
      const std::size_t count = std::min<std::size_t>(estimator_->chunkPixels(), pixels.size() - first);
      const std::span<const std::uint32_t> chunk(pixels.data() + first, count);
      const std::span<const interop::PixelSums> sums = estimator_->run(chunk, samples, options_.seed);
      if (report_.firstDispatchSeconds == 0.0) {
        report_.firstDispatchSeconds = secondsSince(start_);
      }
      const bool last = rounds.done + samples.count == rounds.batchSamples;
      for (std::size_t i = 0; i < count; ++i) {
        BatchSums batchSums = toBatchSums(sums[i]);
        if (options_.moments) {
          addSquare(filmIndex(chunk[i]), batchSums);
        }
        if (!rounds.sums.empty()) {
          addTo(rounds.sums[first + i], batchSums);
          rounds.taken[first + i] += samples.count;
          batchSums = rounds.sums[first + i];
        }
        if (last) {
          takeBatch(chunk[i], batch, rounds.batchSamples, batchSums);
        }
      }
      const double share = double(first + count) / double(pixels.size());
      afterChunk(batch, (rounds.done + share * samples.count) / rounds.batchSamples);
    }
  }

  void takeBatch(std::uint32_t pixel, std::uint32_t batch, std::uint32_t count, const BatchSums& sums) {
    if (pictureTakesBatch_) {
      film_.add(filmIndex(pixel), batch, count, sums);
    }
    if (decisions_) {
      decisions_->add(filmIndex(pixel), batch, count, sums);
    }
  }

  /// Of one sample.
  void addSquare(std::size_t pixel, const BatchSums& sample) {
    const double value = luminance({sample.moments[film::R], sample.moments[film::G], sample.moments[film::B]});
    report_.sampleSquares[pixel] += value * value;
  }

  BatchSums toBatchSums(const interop::PixelSums& device) const {
    BatchSums sums;
    std::copy(std::begin(device.moments), std::end(device.moments), sums.moments.begin());
    std::copy(std::begin(device.extras), std::end(device.extras), sums.extras.begin());
    if (!scene_.film.transparent) {
      for (std::size_t channel = 0; channel < 3; ++channel) {
        sums.moments[channel] += sums.extras[film::BackgroundR + channel];
      }
    }
    return sums;
  }

  void afterChunk(std::uint32_t batch, double done) {
    const double seconds = secondsSince(start_);
    const double batches = std::max(1.0, double(options_.stop.samples) / kBatchSamples);
    Progress progress;
    progress.fraction = std::min(1.0, (batch + done) / batches);
    if (options_.stop.seconds) {
      progress.fraction = std::clamp(seconds / *options_.stop.seconds, progress.fraction, 1.0);
    }
    progress.samples = estimator_->totals().samples;
    progress.samplesPerPixel = std::min<double>(options_.stop.samples, (batch + done) * kBatchSamples);
    progress.seconds = seconds;
    progress.error = error_;
    progress.nonFinite = estimator_->totals().nonFinite;
    if (options_.progress) {
      options_.progress(progress);
    }
    if (options_.interrupted != nullptr && *options_.interrupted) {
      report_.stoppedBy = "interrupt";
    } else if (options_.stop.seconds && seconds >= *options_.stop.seconds && (batch > 0 || done >= 1.0)) {
      report_.stoppedBy = "time"; // but every pixel gets its first batch
    }
    if (seconds - lastCheckpoint_ >= options_.checkpointSeconds && !decisions_ && !inRounds_) {
      saveCheckpoint();
    }
  }

  /// Rare events add up over all runs that went into the film.
  void noteCounts() {
    const Totals& totals = estimator_->totals();
    const std::map<std::string, std::uint64_t> now{
        {"count.nonFinite", totals.nonFinite}, {"count.majorantExceeded", totals.majorantExceeded},
        {"count.negative", totals.negative},   {"count.cut", totals.cut},
        {"count.lookups", totals.lookups},     {"count.segments", totals.segments},
        {"count.samples", totals.samples}};
    for (const auto& [key, count] : now) {
      film_.metadata[key] = std::to_string(countsBefore_[key] + count);
    }
  }

  void noteProvenance() {
    std::uint32_t end = 0;
    for (const film::PixelState& pixel : film_.pixels()) {
      end = std::max(end, pixel.samples[0] + pixel.samples[1]);
    }
    film::setProvenance(film_, {options_.sceneHash, device_, options_.seed, 0, end});
  }

  void saveCheckpoint() {
    lastCheckpoint_ = secondsSince(start_);
    if (!options_.checkpoint.empty()) {
      noteCounts();
      const Guiding* guiding = estimator_->guiding();
      film::saveCheckpoint(options_.checkpoint, film_, {},
                           guiding != nullptr ? guide::packStore(guiding->store().content())
                                              : std::vector<std::byte>());
    }
  }

  const scene::Scene& scene_;
  const RenderOptions& options_;
  RenderReport& report_;
  Clock::time_point start_ =
      Clock::now() - std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options_.secondsBefore));
  Estimator* estimator_;
  std::string device_;
  Film film_;
  std::vector<bool> coverage_;
  std::vector<std::uint32_t> order_;
  double error_ = std::numeric_limits<double>::infinity();
  double lastCheckpoint_ = 0.0;
  double lastError_ = 0.0;
  bool pictureTakesBatch_ = true;
  bool inRounds_ = false; ///< the chains know samples that the film has not taken: no state to go on from
  bool dropped_ = false;  ///< rounds were broken off whose bits would not be those of a render without a break
  std::optional<Film> decisions_;
  std::map<std::string, std::uint64_t> countsBefore_; ///< of earlier runs, from the checkpoint
};

} // namespace

Film renderFilm(const gpu::Device& device, const scene::Scene& scene, const gpu_scene::VolumeSet& volumes,
                const gpu_scene::GpuScene& gpuScene, const RenderOptions& options, RenderReport& report) {
  const Clock::time_point start = Clock::now();
  const std::unique_ptr<Estimator> estimator = makeEstimator(device, gpuScene, volumes, options.estimator);
  RenderOptions timed = options;
  timed.secondsBefore += secondsSince(start);
  return renderFilm(device, scene, volumes, *estimator, timed, report);
}

Film renderFilm(const gpu::Device& device, const scene::Scene& scene, const gpu_scene::VolumeSet& volumes,
                Estimator& estimator, const RenderOptions& options, RenderReport& report) {
  report = RenderReport{}; // one that says why an earlier render stopped would stop this one
  return Session(device, scene, volumes, estimator, options, report).run();
}

} // namespace tyndall::render

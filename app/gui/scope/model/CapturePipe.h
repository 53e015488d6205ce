// CapturePipe.h - prepares captures for the screen on a thread of its own: reads files, measures, averages, tests
// against a mask and builds pyramids. The window never waits for this work.
//
// Work is done in order. If the bench triggers faster than captures can be measured, some are skipped here and reported
// by skipped(). The session file is written elsewhere and loses none of them.
//
// Thread-safety: the GUI thread; results arrive there.
#pragma once

#include <QObject>
#include <QString>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>

#include "app/gui/controller/SideWork.h"
#include "app/gui/scope/model/Trace.h"
#include "core/devices/Oscilloscope.h"
#include "core/measure/Capture.h"
#include "core/measure/CaptureAverage.h"
#include "core/measure/SampleTrigger.h"

namespace tacto::gui {

/// Returns the same samples and times with the trigger moved to where the straight line between two samples of the
/// trigger's channel rises through the level. An edge then stands still from capture to capture. Returns the capture
/// unchanged if no such crossing lies within one sample interval of the trigger that the oscilloscope states. Measured
/// values do not change.
[[nodiscard]] std::shared_ptr<const Capture> triggeredAtCrossing(std::shared_ptr<const Capture> capture,
                                                                 const ScopeSettings& settings);

class CapturePipe final : public QObject {
    Q_OBJECT
public:
    explicit CapturePipe(QObject* parent = nullptr);
    ~CapturePipe() override;  ///< waits until the present work is done

    /// Sets how many of the bench's captures are averaged; 1: no averaging. Another number restarts the mean.
    void setAverage(std::size_t captures);
    /// Tests the bench's captures against this mask from now on; null: no test.
    void setMask(std::shared_ptr<const CaptureMask> mask) { mask_ = std::move(mask); }
    /// Sets the trigger of the bench's next captures. For the oscilloscope's own trigger time 0 is where the signal
    /// crosses the level; another one is searched for, and a capture without it is untriggered.
    void setTrigger(const ScopeSettings& settings, const SampleTrigger& trigger = {});
    /// Sets the drive that is asked of the output while the next captures are taken.
    void setAsked(const std::optional<AskedDrive>& asked) { asked_ = asked; }
    /// The next capture does not follow the last one, because the oscilloscope's settings changed.
    void breakOff() { gap_ = true; }
    /// Starts over with another bench or another load: earlier captures do not enter the mean, and captures still being
    /// measured are dropped.
    void beginAnew();
    void setMathOptions(const MathOptions& math) { mathOptions_ = math; }
    void take(std::shared_ptr<const Capture> capture, const QString& source = {});
    void open(const QString& path);
    /// Stops reading the present file, and does not show it.
    void cancelOpen();
    /// Searches a record for a trigger in its first channel in `unit`; `then` gets the places of triggersIn().
    void search(const ShownPtr& shown, const SampleTrigger& trigger, const QString& unit,
                std::function<void(std::vector<double>)> then);
    /// Calculates the math of a measured capture again with the present options.
    void recalculate(const ShownPtr& shown);

    /// Saves with saveData() in the background; ends with saved() or failed().
    void save(const ShownPtr& shown, double from_s, double to_s, const QString& path);

    [[nodiscard]] bool opening() const noexcept { return opening_; }
    /// Progress of the file being read, in per cent. openingChanged() reports each change.
    [[nodiscard]] int percentRead() const noexcept { return percentRead_; }
    [[nodiscard]] std::uint64_t skippedCaptures() const noexcept { return skipped_; }

signals:
    void prepared(tacto::gui::ShownPtr shown);
    void recalculated(tacto::gui::ShownPtr shown);
    void openingChanged();
    void saved(const QString& path);
    void failed(const QString& what);

private:
    void tellRead(double part);  // called on the reading thread

    MathOptions mathOptions_;
    std::shared_ptr<const CaptureMask> mask_;
    std::optional<ScopeSettings> trigger_;
    std::optional<AskedDrive> asked_;
    CaptureAverage average_;      // used by the worker thread only
    SampleTriggerSearch search_;  // likewise
    bool passesOver_ = false;     // the trigger leaves out trains between two captures
    bool gap_ = false;            // a capture was left out after the last one
    std::uint64_t epoch_ = 1;     // counts the calls of beginAnew(): captures of an earlier epoch are dropped
    int pending_ = 0;
    std::uint64_t skipped_ = 0;
    bool opening_ = false;
    std::uint64_t openNumber_ = 0;
    std::stop_source reading_;
    std::atomic<int> percentRead_{0};
    std::atomic<std::uint64_t> wantedOpen_{0};  // also read by the worker thread: a cancelled file is not measured
    SideWork work_;                             // the last member, as its thread uses the others
};

/// Writes channels and calculated curves between from_s and to_s (session's time base) to a capture file
/// (core/measure/CaptureFile.h). An existing file is replaced completely or stays as it is. Returns an error as a
/// sentence.
[[nodiscard]] std::optional<QString> saveData(const ShownCapture& shown, double from_s, double to_s,
                                              const QString& path);

}  // namespace tacto::gui

// CaptureStrip.h - a small plot of the last captured waveform: voltage and current over time.
#pragma once

#include <filesystem>
#include <memory>
#include <qcustomplot.h>
#include <string>
#include <string_view>

#include "core/base/Result.h"
#include "core/measure/Capture.h"

namespace tacto::gui {

class CaptureStrip final : public QCustomPlot {
    Q_OBJECT
public:
    explicit CaptureStrip(QWidget* parent = nullptr);
    /// Shows the capture, with `title` above it; empty for the last capture. Null empties the plot, and `title` says
    /// why.
    void show(const std::shared_ptr<const Capture>& capture, const QString& title = {});
    [[nodiscard]] QString title() const { return title_->text(); }
    /// True if no trace is drawn.
    [[nodiscard]] bool empty() const { return empty_->visible(); }

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void colour();
    /// Uses fewer axis numbers if space is short.
    void thinTicks();
    QCPGraph* voltage_ = nullptr;
    QCPGraph* current_ = nullptr;
    QCPItemText* watermark_ = nullptr;
    QCPItemText* empty_ = nullptr;
    QCPTextElement* title_ = nullptr;
};

// Functions that find the train of a safety check's session that shows how a limit was judged on one load.

/// Returns the highest finite magnitude of the first channel in `unit` ("V", "A"); negative without such a channel.
[[nodiscard]] double peakIn(const Capture& capture, std::string_view unit);

/// Returns the capture with the highest peak among the commands on `load` ("500 ohm"): the peak voltage for a limit in
/// volts, otherwise the peak current, or voltage if no current was measured. Null if nothing was captured on that load.
/// Errors: as SessionReader.
[[nodiscard]] Result<std::shared_ptr<const Capture>> strongestOn(const std::filesystem::path& session,
                                                                 const std::string& load, bool ofVoltage);

}  // namespace tacto::gui

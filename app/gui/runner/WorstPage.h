// WorstPage.h - judges the profile's strongest command against every limit before a run; the limits can be filtered by
// set, and each can be read with its source.
#pragma once

#include <QComboBox>
#include <QLabel>
#include <QString>
#include <QWidget>
#include <vector>

#include "app/gui/controller/BenchController.h"
#include "core/bench/Profile.h"
#include "core/safety/LimitSet.h"
#include "core/safety/TrainExposure.h"

namespace tacto::gui {

class ExposureTable;

class WorstPage final : public QWidget {
    Q_OBJECT
public:
    explicit WorstPage(QWidget* parent);
    /// Judges these settings. Returns why a run would be refused; empty if nothing prevents it. `drives`: the protocol
    /// needs a stimulator.
    [[nodiscard]] QString judge(const BenchController& controller, const Result<ProtocolSettings>& settings,
                                bool drives);

protected:
    bool event(QEvent* event) override;

private:
    [[nodiscard]] QWidget* buildChooser();
    void show(std::vector<ExposureRow> rows);
    void filter();

    const std::vector<LimitSet>* sets_ = nullptr;
    std::vector<ExposureRow> rows_;
    QComboBox* chooser_ = nullptr;
    ExposureTable* worst_;
    QLabel* says_;
};

// The strongest command of a profile, judged before anything is armed: each limit with the value compared with it, as
// the worst case over 80 to 120 % of the declared load.

struct WorstCase {
    std::vector<ExposureRow> rows;
    QString refused;  ///< the limit that would be exceeded, in words; empty if none
};

/// Returns the preview (core/bench/CommandPreview.h) of the profile's largest amplitude at its shortest interval.
/// Errors: as parseLoad() and previewOf().
[[nodiscard]] Result<WorstCase> worstCase(const Profile& profile, const std::vector<LimitSet>& limits,
                                          const std::string& load);

}  // namespace tacto::gui

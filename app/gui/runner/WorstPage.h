// WorstPage.h - the strongest command of the profile, judged against every limit before a run; the limits of one
// set alone where it is chosen, and each to be read with its source.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QComboBox>
#include <QLabel>
#include <QWidget>
#include <vector>

#include "app/gui/controller/BenchController.h"
#include "core/safety/LimitSet.h"

namespace tacto::gui {

class ExposureTable;

class WorstPage final : public QWidget {
    Q_OBJECT
public:
    explicit WorstPage(QWidget* parent);
    /// Judges these settings. Returns why a run of them would be refused; empty where nothing is in its way. `drives`:
    /// the protocol needs a stimulator.
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

}  // namespace tacto::gui

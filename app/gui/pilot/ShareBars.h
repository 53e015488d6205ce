// ShareBars.h - bars that fill: the blocks of a test side by side, the time to answer, the time of a phase.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QWidget>
#include <vector>

namespace tacto::gui {

class ShareBars final : public QWidget {
    Q_OBJECT
public:
    explicit ShareBars(QWidget* parent);
    /// One bar each, 0 to 1.
    void setShares(const std::vector<double>& shares);
    [[nodiscard]] const std::vector<double>& shares() const { return shares_; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    std::vector<double> shares_;
};

/// How full each block's bar is: finished blocks are full, the present one in proportion to its trials. `trial` counts
/// all `trials` from 1; all blocks have the same length.
[[nodiscard]] std::vector<double> blockShares(int block, int blocks, int trial, int trials);

}  // namespace tacto::gui

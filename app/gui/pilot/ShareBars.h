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
    void setGap(int px) { gap_ = px; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    std::vector<double> shares_;
    int gap_ = 8;
};

/// Of each block's bar: those before are full, the one under way as far as it is. `trial` of all `trials`, from 1; the
/// blocks are of one length.
[[nodiscard]] std::vector<double> blockShares(int block, int blocks, int trial, int trials);

}  // namespace tacto::gui

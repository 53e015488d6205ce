// MaskPanel.h - tests captures against a mask, which is a band around a reference capture; counts the captures inside,
// and keeps the first one outside.
//
// A capture outside the mask is reported in words and on the screen until the counts are reset. A mask only judges
// captures and never controls the output.
#pragma once

#include <QPushButton>
#include <memory>

#include "app/gui/scope/model/Trace.h"

class QLabel;
class QSettings;

namespace tacto::gui {

class QuantitySpin;

class MaskPanel final : public QWidget {
    Q_OBJECT
public:
    explicit MaskPanel(QWidget* parent = nullptr);

    /// Null while captures are not tested.
    [[nodiscard]] const std::shared_ptr<const CaptureMask>& mask() const noexcept { return mask_; }
    /// Makes a band around `reference` and tests captures against this band from now on. Shows any error on the panel.
    void make(const ShownPtr& reference);
    void remove();
    /// Counts a capture, whether it was judged or not.
    void take(const ShownPtr& shown);
    [[nodiscard]] const MaskCounts& counts() const noexcept { return counts_; }
    /// The first capture outside the mask; null if there is none yet.
    [[nodiscard]] const ShownPtr& firstOutside() const noexcept { return first_; }
    /// "Mask: 24 of 24 captures inside"; empty if there is no mask.
    [[nodiscard]] QString said() const;
    /// The alarm text over the traces after a capture outside the mask; otherwise empty.
    [[nodiscard]] QString alarm() const;
    void canMake(bool can) { make_->setEnabled(can); }

    void save(QSettings& settings) const;
    /// Restores the half-widths; masks are not saved.
    void restore(const QSettings& settings);

public slots:
    void resetCounts();

signals:
    /// The user asks for a mask around the shown capture.
    void makeWanted();
    void maskChanged();
    void countsChanged();
    void firstOutsideWanted();

private:
    [[nodiscard]] MaskBand band() const;
    void makeOf(std::shared_ptr<const Capture> reference);
    void bandChanged();
    void say();

    std::shared_ptr<const CaptureMask> mask_;
    std::shared_ptr<const Capture> reference_;
    MaskCounts counts_;
    ShownPtr first_;
    QString problem_;
    QString whyNot_;  ///< why the last capture was not tested
    QuantitySpin* volts_;
    QuantitySpin* amps_;
    QuantitySpin* time_;
    QPushButton* make_;
    QPushButton* remove_;
    QPushButton* reset_;
    QPushButton* showFirst_;
    QLabel* says_;
};

}  // namespace tacto::gui

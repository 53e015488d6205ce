// MaskPanel.h - a test of captures against a mask: the band around what is shown, how many lie inside, and the first
// that does not, which is kept.
//
// A capture outside stays said, in words and on the screen, until the counts are reset. A mask judges and does nothing
// else: it never controls the output.
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
    /// A band around this capture, which is tested against from now on. Says here what is wrong with it.
    void make(const ShownPtr& reference);
    void remove();
    /// A capture that was judged, or was not.
    void take(const ShownPtr& shown);
    [[nodiscard]] const MaskCounts& counts() const noexcept { return counts_; }
    /// The first capture outside; null before there is one.
    [[nodiscard]] const ShownPtr& firstOutside() const noexcept { return first_; }
    /// "Mask: 24 of 24 captures inside"; empty without a mask.
    [[nodiscard]] QString said() const;
    /// The alarm over the traces after a capture outside; else empty.
    [[nodiscard]] QString alarm() const;
    void canMake(bool can) { make_->setEnabled(can); }

    void save(QSettings& settings) const;
    /// The half-widths; a mask itself is not kept.
    void restore(const QSettings& settings);

public slots:
    void resetCounts();

signals:
    /// The user asks for a mask around what is shown.
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
    QString whyNot_;  ///< why the last capture was not judged
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

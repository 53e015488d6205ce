// InstrumentDialog.h - the laboratory's oscilloscopes, shunts and probes: saved once by name, then chosen.
//
// The choices form the address of the oscilloscope. An instrument with an expired certificate is marked, and its values
// are left out: unknown is not zero (hazard H9).
#pragma once

#include <QDialog>
#include <QLabel>
#include <QPushButton>

#include "app/gui/theme/FieldForm.h"
#include "app/run/InstrumentPresets.h"

namespace tacto::gui {

class InstrumentDialog final : public QDialog {
    Q_OBJECT
public:
    explicit InstrumentDialog(QWidget* parent);

signals:
    /// The address of the chosen oscilloscope, with the values stated for it, its shunt and its probe.
    void chosen(const QString& address);

private:
    void buildChoice(QVBoxLayout& column);
    void buildForm(QVBoxLayout& column);
    void read();
    void compose();
    [[nodiscard]] ChosenInstruments picked() const;
    [[nodiscard]] InstrumentKind formKind() const;
    /// Returns the instrument entered in the form. Errors: InvalidArgument, one sentence.
    [[nodiscard]] Result<InstrumentPreset> written() const;
    void judge();
    void save();
    void remove();

    std::vector<InstrumentPreset> all_;
    FieldForm* choice_ = nullptr;  // one field for each kind of instrument
    QLabel* address_ = nullptr;
    QLabel* said_ = nullptr;
    QPushButton* use_ = nullptr;
    FieldForm* form_ = nullptr;
    QLabel* trouble_ = nullptr;
    QPushButton* save_ = nullptr;
    QPushButton* remove_ = nullptr;
};

}  // namespace tacto::gui

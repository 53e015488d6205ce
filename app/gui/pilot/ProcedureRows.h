// ProcedureRows.h - rows of a form: what a session runs, and how it finds the level that is just felt. A session that
// is gone on with keeps what it began with.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QComboBox>
#include <QFormLayout>

#include "app/gui/pilot/PilotStart.h"
#include "app/gui/pilot/UnfinishedOffer.h"

namespace tacto::gui {

class ProcedureRows final : public QObject {
    Q_OBJECT
public:
    /// `name`: what the names of its widgets begin with. The boxes belong to `parent`, which is their place in the
    /// order of Tab.
    ProcedureRows(const QString& name, QWidget& parent);
    void addTo(QFormLayout& form);
    void writeTo(PilotStart& start) const;
    /// Where an interrupted session goes on, its own.
    void follow(const UnfinishedOffer& offer);
    void setMethod(const QString& method);
    /// Else thresholds alone.
    [[nodiscard]] bool isWhole() const { return protocol_->currentIndex() == 0; }

signals:
    void changed();

private:
    QComboBox* protocol_;
    QComboBox* method_;
};

}  // namespace tacto::gui

// PilotResult.h - shows the result of a pilot session: the headline sentence, the confusion matrix, blocks, the
// predictions, and the possible next steps.
//
// Thread-safety: the GUI thread; resultSentence() is a pure function.
#pragma once

#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <QWidget>
#include <nlohmann/json.hpp>

#include "app/gui/study/PageTable.h"
#include "app/run/ProtocolRun.h"

namespace tacto::gui {

/// Returns the headline from the results of pilot-identification: "P-7K3M told the four apart in 68 of 80 trials (85 %,
/// 95 % interval 76 to 91 %, chance 25 %) between 4.0 and 6.5 mA, 14 to 22 V at 3.4 kΩ."; for pilot-thresholds a
/// sentence built from its results; empty for any other results.
[[nodiscard]] QString resultSentence(const nlohmann::json& results);

class PilotResult final : public QWidget {
    Q_OBJECT
public:
    explicit PilotResult(QWidget* parent = nullptr);
    /// `folder`: the study's folder. `ofStudy`: the page leads back to the study.
    void show(const RunResult& result, const QString& folder, bool ofStudy = false);
    /// Offers to go on with the session, or not: until the next show() it is not offered.
    void setMayGoOn(bool may);
    /// Shows a sentence below the result.
    void say(const QString& what);

signals:
    void anotherWanted();  ///< asks for a new rehearsal
    void backWanted();
    void goOnWanted();  ///< asks to continue the unfinished session
    void folderWanted(const QString& folder);
    void reportWanted();
    void exportWanted();  ///< asks to export a rehearsal; a study is exported on its page

private:
    void showMatrix(const nlohmann::json& results);
    QString folder_;
    bool ofStudy_ = false;
    QLabel* head_;
    QLabel* why_;
    QLabel* more_;
    QLabel* matrixTitle_;
    PageTable* matrix_;
    QLabel* blocks_;
    QLabel* note_;
    QPushButton* goOn_;
    QPushButton* another_;
    QPushButton* back_;
    QPushButton* report_;
    QPushButton* export_;
    QPushButton* place_;
};

}  // namespace tacto::gui

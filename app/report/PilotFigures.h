// PilotFigures.h - the figures of a pilot study to publish: of each session, of each person and over people. Each is
// described once here; the window, the report and the SVG files draw this description (FigureDrawing.h).
//
// Answers of different people are never pooled. A curve over people is the mean of the people's values with the
// interval of meanOverPeople() (EncodingsOverPeople.h). A figure without data is left out.
//
// Thread-safety: pure functions; addFigures() and writeFigures() on the GUI thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/report/Figure.h"
#include "app/report/StudyPerson.h"

namespace tacto {

struct PilotFigure {
    std::string name;  ///< for its file: "P-7K3M-session-1-function"
    QString caption;
    Figure figure;
    bool simulated = false;
};

/// The psychometric function of detection with its trials, and the estimate after each trial.
[[nodiscard]] Result<std::vector<PilotFigure>> sessionFigures(const StudyPerson& person, const AnalysedSession& one,
                                                              bool massager);
/// Answers over blocks; thresholds and answers over sessions and days; thresholds within sessions; response times.
[[nodiscard]] std::vector<PilotFigure> personFigures(const StudyPerson& person, bool massager);
/// The same for several people of one kind, and the differences of two encodings. `people`: without those who withdrew.
[[nodiscard]] Result<std::vector<PilotFigure>> peopleFigures(const std::vector<StudyPerson>& people, bool massager);

/// Draws figures into a report.
void addFigures(std::vector<ReportBlock>& blocks, Captions& captions, const std::vector<PilotFigure>& figures);

/// Returns all figures of a study: of each kind of participants as byBasis(), those over people first.
[[nodiscard]] Result<std::vector<PilotFigure>> pilotFigures(const StudyRecord& study);

/// Writes each figure as SVG, "NAME.svg", into a new or empty folder. Errors: Unsupported if a font is missing; as
/// checkBidsFolder() and writeBids().
[[nodiscard]] Result<void> writeFigures(const std::vector<PilotFigure>& figures, const std::filesystem::path& folder);

}  // namespace tacto

// The reference as pages, out of what the program knows.
#include "runner/commands/words/manual.h"
#include "runner/experiments/regulation/regulation_result.h"
#include "runner/files/durable_files.h"
#include "runner/findings/key_reference.h"
#include "runner/findings/lists.h"
#include "runner/write/document.h"
#include "scenarios/drives/drive.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

namespace fernlicht {

void add_docs_command(CLI::App& app, std::function<int()>& chosen) {
    const auto folder = std::make_shared<std::filesystem::path>();
    CLI::App* sub = app.add_subcommand("docs", "write the reference as Markdown: commands, keys, quantities, techniques, regulations");
    sub->add_option("DIR", *folder, "folder for the pages; those that are there are replaced")->required();
    sub->callback([&app, folder, &chosen] {
        chosen = [&app, folder] {
            const std::pair<const char*, Document> pages[] = {{"commands", commands_document(app)},
                                                              {"exit-codes", exit_codes_document()},
                                                              {"keys", keys_document()},
                                                              {"quantities", quantities_reference()},
                                                              {"regulations", regulation_reference()},
                                                              {"techniques", techniques_reference(techniques(), shadow_method_names())}};
            make_folder(*folder);
            for (const auto& [name, document] : pages)
                write_file(*folder / (std::string(name) + ".md"), document_markdown(document));
            return 0;
        };
    });
}

} // namespace fernlicht

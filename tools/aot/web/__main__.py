"""``python -m tools.aot.web``: make signatures and types anew from the kernels."""

from tools.aot.web.generated import FILES

if __name__ == "__main__":
    for file, content in FILES.items():
        file.write_text(content(), encoding="utf-8")
        print(file)

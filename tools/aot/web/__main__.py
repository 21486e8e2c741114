"""``python -m tools.aot.web``: make the types of the WebAssembly module anew from the kernels."""

from tools.aot.web.generated import FILES, WEB

if __name__ == "__main__":
    for name, content in FILES.items():
        (WEB / name).write_text(content(), encoding="utf-8")
        print(WEB / name)

import cutting

try:
    cutting.count_triangles("no such file.obj")
    raise SystemExit("a file was read that is not there")
except cutting.FileError as error:
    assert "no such file.obj" in str(error)
print(cutting.outcome())

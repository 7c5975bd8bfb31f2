# sslam on Debian 12, by the README's first command, which also tracks a rendered room.
#   docker build -t sslam .
#   docker run --rm -v "$PWD:/data" sslam run /data/VIDEO.mp4 --out /data/results
FROM debian:12
COPY . /sslam
WORKDIR /sslam
RUN ./scripts/quickstart /tmp/demo && rm -r /tmp/demo
WORKDIR /data
ENTRYPOINT ["/sslam/build/cli/sslam"]
